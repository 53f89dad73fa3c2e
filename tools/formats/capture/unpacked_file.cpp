#include "tools/formats/capture/unpacked_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <zlib.h>
#include <zstd.h>

#include "tools/formats/capture/file_hint.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {

class UnpackedFile::Unpacker {
 public:
  struct Step {
    std::size_t taken = 0;
    std::size_t made = 0;
    bool is_between = false;  // one packed piece has ended, and another one may follow
    std::string error{};
  };

  Unpacker() = default;
  virtual ~Unpacker() = default;
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual Step step(std::span<const std::byte> from, std::span<std::byte> to) = 0;

  bool is_between = false;
};

namespace {

using namespace std::string_view_literals;

constexpr std::size_t kBufferBytes = 64U << 10;
constexpr std::size_t kBeginBytes = 1208;
constexpr std::string_view kGzipMagic = "\x1F\x8B"sv;
constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD"sv;

bool begins_with(std::span<const std::byte> bytes, std::string_view magic) {
  const auto expected = std::as_bytes(std::span(magic));
  return bytes.size() >= magic.size() && std::ranges::equal(bytes.first(magic.size()), expected);
}

class Gzip final : public UnpackedFile::Unpacker {
 public:
  Gzip() {
    constexpr int kLargestWindow = 15;
    constexpr int kGzipHeader = 16;  // zlib's manual, inflateInit2
    if (inflateInit2(&stream_, kLargestWindow + kGzipHeader) != Z_OK) {
      throw UsageError("no memory to unpack gzip");
    }
  }
  ~Gzip() override { inflateEnd(&stream_); }
  Gzip(const Gzip&) = delete;
  Gzip& operator=(const Gzip&) = delete;

  [[nodiscard]] std::string name() const override { return "gzip"; }

  [[nodiscard]] Step step(std::span<const std::byte> from, std::span<std::byte> to) override {
    if (is_between) {
      inflateReset(&stream_);
    }
    // zlib does not write to its input; its C interface only knows no const.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(from.data()));
    stream_.avail_in = static_cast<uInt>(from.size());
    stream_.next_out = reinterpret_cast<Bytef*>(to.data());
    stream_.avail_out = static_cast<uInt>(to.size());
    const int status = inflate(&stream_, Z_NO_FLUSH);
    Step step{.taken = from.size() - stream_.avail_in,
              .made = to.size() - stream_.avail_out,
              .is_between = status == Z_STREAM_END};
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
      step.error = stream_.msg != nullptr ? stream_.msg : "error " + std::to_string(status);
    }
    return step;
  }

 private:
  z_stream stream_{};
};

// libzstd refuses a window of more than 128 MiB, so memory is bounded.
class Zstd final : public UnpackedFile::Unpacker {
 public:
  Zstd() : context_(ZSTD_createDCtx()) {}
  ~Zstd() override { ZSTD_freeDCtx(context_); }
  Zstd(const Zstd&) = delete;
  Zstd& operator=(const Zstd&) = delete;

  [[nodiscard]] std::string name() const override { return "zstd"; }

  [[nodiscard]] Step step(std::span<const std::byte> from, std::span<std::byte> to) override {
    ZSTD_inBuffer in{.src = from.data(), .size = from.size(), .pos = 0};
    ZSTD_outBuffer out{.dst = to.data(), .size = to.size(), .pos = 0};
    const std::size_t status = ZSTD_decompressStream(context_, &out, &in);
    const bool is_error = ZSTD_isError(status) != 0;
    return {.taken = in.pos,
            .made = out.pos,
            .is_between = status == 0,
            .error = is_error ? ZSTD_getErrorName(status) : ""};
  }

 private:
  ZSTD_DCtx* context_;
};

std::unique_ptr<UnpackedFile::Unpacker> unpacker_of(std::span<const std::byte> begin) {
  if (begins_with(begin, kGzipMagic)) {
    return std::make_unique<Gzip>();
  }
  return begins_with(begin, kZstdMagic) ? std::make_unique<Zstd>() : nullptr;
}

}  // namespace

UnpackedFile::UnpackedFile(const std::string& path) : buffer_(kBufferBytes) {
  errno = 0;
  descriptor_ = path == "-" ? dup(STDIN_FILENO) : open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat facts {};
  if (descriptor_ < 0 || fstat(descriptor_, &facts) != 0) {
    throw file_error(path, "cannot be read");
  }
  if (S_ISDIR(facts.st_mode)) {
    close(descriptor_);
    throw UsageError(path + (is_folder_of_bag(path) ? ": a bag of ROS 2" + hint_of_ros()
                                                    : ": cannot be read: it is a folder"));
  }
  file_bytes_ = S_ISREG(facts.st_mode) ? static_cast<std::uint64_t>(facts.st_size) : 0;
  // A pipe may hand over its first bytes one by one.
  while (input_.size() < kZstdMagic.size() && !has_ended_) {
    const ssize_t got =
        ::read(descriptor_, &buffer_[input_.size()], buffer_.size() - input_.size());
    has_ended_ = got <= 0;
    input_ = std::span(buffer_).first(input_.size() +
                                      static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  }
  packed_ = input_.size();
  unpacker_ = unpacker_of(input_);
}

UnpackedFile::~UnpackedFile() { close(descriptor_); }

std::string UnpackedFile::packer() const { return unpacker_ ? unpacker_->name() : ""; }

std::optional<double> UnpackedFile::part_read() const {
  if (file_bytes_ == 0) {
    return std::nullopt;
  }
  const auto taken = static_cast<double>(packed_ - input_.size());
  return std::min(1.0, taken / static_cast<double>(file_bytes_));
}

bool UnpackedFile::go_to(std::uint64_t place) {
  if (!can_go() || lseek(descriptor_, static_cast<off_t>(place), SEEK_SET) < 0) {
    return false;
  }
  packed_ = unpacked_ = place;
  input_ = {};
  has_ended_ = false;
  trouble_.clear();
  return true;
}

bool UnpackedFile::has_input() {
  if (!input_.empty() || has_ended_) {
    return !input_.empty();
  }
  errno = 0;
  const ssize_t got = ::read(descriptor_, buffer_.data(), buffer_.size());
  if (got < 0) {
    trouble_ = "cannot be read further: " + std::generic_category().message(errno);
  }
  has_ended_ = got <= 0;
  input_ = std::span(buffer_).first(static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  packed_ += input_.size();
  return !has_ended_;
}

std::size_t UnpackedFile::read(std::span<std::byte> to) {
  if (!trouble_.empty() || to.empty()) {
    return 0;
  }
  std::size_t made = 0;
  if (unpacker_) {
    made = unpack(to);
  } else if (has_input()) {
    made = std::min(to.size(), input_.size());
    std::ranges::copy(input_.first(made), to.begin());
    input_ = input_.subspan(made);
  }
  unpacked_ += made;
  const std::size_t wanted = kBeginBytes - std::min(kBeginBytes, begin_.size());
  begin_.insert(begin_.end(), to.begin(),
                to.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, made)));
  return made;
}

std::size_t UnpackedFile::unpack(std::span<std::byte> to) {
  const std::string name = unpacker_->name();
  while (true) {
    const bool has_more = has_input();
    if (!has_more && unpacker_->is_between) {
      return 0;
    }
    // What has been taken may still be on its way out, so there is a step without input, too.
    const Unpacker::Step step = unpacker_->step(input_, to);
    input_ = input_.subspan(step.taken);
    unpacker_->is_between = step.is_between;
    if (!step.error.empty()) {
      trouble_ = "cannot be unpacked further: " + name + ": " + step.error;
    } else if (!has_more && step.made == 0 && !step.is_between && trouble_.empty()) {
      trouble_ = "breaks off: the end of what " + name + " has packed is missing";
    } else if (unpacked_ + step.made > std::max(kAlwaysUnpacked, kMaxRatio * packed_)) {
      trouble_ = "unpacks to more than " + std::to_string(kMaxRatio) +
                 " times its size, which no capture does; not read further";
      return 0;
    }
    if (step.made > 0 || !trouble_.empty()) {
      return step.made;
    }
  }
}

}  // namespace iog::tools
