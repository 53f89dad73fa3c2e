#include "stage_map.hpp"

#include <algorithm>
#include <dwarf.h>
#include <elfutils/libdw.h>
#include <fcntl.h>
#include <map>
#include <stdexcept>
#include <string_view>
#include <unistd.h>

namespace iog::a9_model {
namespace {

class Image {
 public:
  explicit Image(const std::string& path)
      : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)), dwarf_(dwarf_begin(file_, DWARF_C_READ)) {
    if (dwarf_ == nullptr) {
      close(file_);
      throw std::runtime_error(path + " has no debug information");
    }
  }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  ~Image() {
    dwarf_end(dwarf_);
    close(file_);
  }

  [[nodiscard]] Dwarf* dwarf() const { return dwarf_; }
  [[nodiscard]] Elf* elf() const { return dwarf_getelf(dwarf_); }

  // Of what is loaded and executed.
  struct Range {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
  };
  [[nodiscard]] Range code() const {
    std::size_t headers = 0;
    elf_getphdrnum(elf(), &headers);
    Range code{.begin = UINT32_MAX};
    for (std::size_t index = 0; index < headers; ++index) {
      GElf_Phdr header;
      if (gelf_getphdr(elf(), static_cast<int>(index), &header) != nullptr &&
          header.p_type == PT_LOAD && (header.p_flags & PF_X) != 0) {
        code.begin = std::min(code.begin, header.p_vaddr);
        code.end = std::max(code.end, header.p_vaddr + header.p_filesz);
      }
    }
    return code;
  }

 private:
  int file_;
  Dwarf* dwarf_;
};

// The mapping symbols ($a, $t, $d) of ELF for the Arm Architecture say what begins where.
std::map<std::uint64_t, bool> thumb_from(Elf* elf) {
  std::map<std::uint64_t, bool> result;
  for (Elf_Scn* section = nullptr; (section = elf_nextscn(elf, section)) != nullptr;) {
    GElf_Shdr header;
    if (gelf_getshdr(section, &header) == nullptr || header.sh_type != SHT_SYMTAB) {
      continue;
    }
    Elf_Data* const table = elf_getdata(section, nullptr);
    GElf_Sym symbol;
    for (int index = 0; gelf_getsym(table, index, &symbol) != nullptr; ++index) {
      const char* const found = elf_strptr(elf, header.sh_link, symbol.st_name);
      const std::string_view name = found != nullptr ? found : "";
      if (name == "$a" || name == "$t" || name == "$d") {
        result[symbol.st_value] = name == "$t";
      }
    }
  }
  return result;
}

std::string_view without_extension(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return path.substr(0, dot < path.size() && path.find('/', dot) == path.npos ? dot : path.size());
}

// fuse_groups<iog::perception::TileBefore> is fuse_groups.
std::string_view without_arguments(std::string_view name) { return name.substr(0, name.find('<')); }

bool is_of(const StageRule& rule, std::string_view name, std::string_view path) {
  return without_arguments(name) == rule.function &&
         without_extension(path).ends_with("/" + rule.file);
}

// Walks through a compilation unit from the outer functions to the inner ones.
class Painter {
 public:
  Painter(std::span<const StageRule> rules, std::span<const std::string> stages, Image::Range code,
          std::vector<Place>& places)
      : rules_(rules), stages_(stages), code_(code), places_(places), is_found_(rules.size()) {}

  void paint_children(Dwarf_Die& parent, Place outer) {
    Dwarf_Die die;
    if (dwarf_child(&parent, &die) != 0) {
      return;
    }
    do {
      Place place = outer;
      const int tag = dwarf_tag(&die);
      if (tag == DW_TAG_subprogram) {
        place = {.stage = 0, .function = ++functions_};
      }
      if (tag == DW_TAG_subprogram || tag == DW_TAG_inlined_subroutine) {
        paint(die, place);
      }
      paint_children(die, place);
    } while (dwarf_siblingof(&die, &die) == 0);
  }

  [[nodiscard]] const StageRule* missing() const {
    const auto at = std::ranges::find(is_found_, false);
    return at == is_found_.end() ? nullptr
                                 : &rules_[static_cast<std::size_t>(at - is_found_.begin())];
  }

 private:
  void paint(Dwarf_Die& die, Place& place) {
    const char* const name = dwarf_diename(&die);
    const char* const path = dwarf_decl_file(&die);
    const auto rule = std::ranges::find_if(rules_, [&](const StageRule& each) {
      return name != nullptr && path != nullptr && is_of(each, name, path);
    });
    if (rule != rules_.end()) {
      place.stage =
          static_cast<std::uint8_t>(std::ranges::find(stages_, rule->stage) - stages_.begin());
    }
    Dwarf_Addr base = 0;
    Dwarf_Addr begin = 0;
    Dwarf_Addr end = 0;
    for (std::ptrdiff_t next = 0; (next = dwarf_ranges(&die, next, &base, &begin, &end)) > 0;) {
      if (begin < code_.begin || end > code_.end) {
        continue;  // the linker has thrown it away
      }
      std::fill(places_.begin() + index_of(begin), places_.begin() + index_of(end + 3), place);
      if (rule != rules_.end()) {
        is_found_[static_cast<std::size_t>(rule - rules_.begin())] = true;
      }
    }
  }

  [[nodiscard]] std::ptrdiff_t index_of(Dwarf_Addr address) const {
    return static_cast<std::ptrdiff_t>((address - code_.begin) / 4);
  }

  std::span<const StageRule> rules_;
  std::span<const std::string> stages_;
  Image::Range code_;
  std::vector<Place>& places_;
  std::vector<bool> is_found_;
  std::uint32_t functions_ = 0;
};

}  // namespace

StageMap::StageMap(const std::string& image, std::span<const StageRule> rules) {
  const Image file(image);
  const Image::Range code = file.code();
  base_ = static_cast<std::uint32_t>(code.begin);
  places_.resize(code.begin < code.end ? (code.end - code.begin + 3) / 4 : 0);
  thumb_.resize(places_.size());
  for (const auto& [address, is_thumb] : thumb_from(file.elf())) {
    if (address >= code.begin && address < code.end) {
      std::fill(thumb_.begin() + static_cast<std::ptrdiff_t>((address - code.begin) / 4),
                thumb_.end(), is_thumb);
    }
  }
  for (const StageRule& rule : rules) {
    if (std::ranges::find(stages_, rule.stage) == stages_.end()) {
      stages_.push_back(rule.stage);
    }
  }
  Painter painter(rules, stages_, code, places_);
  Dwarf_CU* unit = nullptr;
  Dwarf_Die die;
  while (dwarf_get_units(file.dwarf(), unit, &unit, nullptr, nullptr, &die, nullptr) == 0) {
    painter.paint_children(die, {});
  }
  if (const StageRule* const rule = painter.missing()) {
    throw std::runtime_error(image + " has no " + rule->function + " of " + rule->file);
  }
}

}  // namespace iog::a9_model
