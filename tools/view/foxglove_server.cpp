// A client has one frame under way; when all of that is written it gets the newest one, and what
// came in between is left out for it. So what a client costs is the frame under way, whose bytes it
// shares with the others, and nobody waits for it.
#include <algorithm>
#include <array>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <iostream>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "tools/foxglove/frame_messages.hpp"
#include "tools/foxglove/subscriptions.hpp"
#include "tools/program/time_of_day.hpp"
#include "tools/view/http_door.hpp"
#include "tools/view/literal_host.hpp"
#include "tools/view/servers.hpp"

namespace iog::tools::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

using Clock = std::chrono::steady_clock;
using foxglove::Channel;

constexpr std::chrono::seconds kClientPatience{60};    // with a client that takes nothing
constexpr std::chrono::seconds kTellEvery{1};          // that frames are left out
constexpr std::size_t kMaxClients = 16;                // at the same time
constexpr std::size_t kMaxRequestBytes = 64UL * 1024;  // a thousand subscriptions have room
constexpr std::size_t kMaxTexts = 64;                  // that wait for who does not read
constexpr int kSendBufferBytes = 512 * 1024;           // of the kernel: what waits there grows old

// The first of the client's sub-protocols that is known here; empty if there is none.
std::string_view subprotocol_of(const Request& request) {
  for (const auto& offered : http::token_list(request[http::field::sec_websocket_protocol])) {
    const auto known = std::ranges::find(foxglove::kSubprotocols, text_of(offered));
    if (known != foxglove::kSubprotocols.end()) {
      return *known;
    }
  }
  return {};
}

// Nothing for a client that is let in.
std::optional<Response> answer(const Request& request, bool has_room) {
  const auto refuse = [&](http::status status, std::string words) {
    return plain_answer(request, status, std::move(words));
  };
  const std::string_view host = text_of(request[http::field::host]);
  if (!is_literal_host(host)) {
    return refuse(http::status::forbidden,
                  "Open this connection by its address, such as ws://127.0.0.1:8765\n");
  }
  if (!is_foxglove_or_here(text_of(request[http::field::origin]), host)) {
    return refuse(http::status::forbidden,
                  "Only for programs, pages of this PC and those of foxglove.dev.\n");
  }
  if (!websocket::is_upgrade(request)) {
    Response response =
        refuse(http::status::upgrade_required,
               "This is a connection for Foxglove: open ws://" + std::string(host) + " there.\n");
    response.set(http::field::upgrade, "websocket");
    return response;
  }
  if (subprotocol_of(request).empty()) {
    return refuse(http::status::bad_request,
                  "The WebSocket needs the sub-protocol foxglove.websocket.v1.\n");
  }
  if (!has_room) {
    return refuse(http::status::service_unavailable, "There are too many clients.\n");
  }
  return std::nullopt;
}

class Client : public std::enable_shared_from_this<Client> {
 public:
  // messages outlives the client. on_end: called when it is no more.
  Client(beast::tcp_stream&& stream, foxglove::FrameMessages& messages,
         std::function<void()> on_end)
      : socket_(std::move(stream)), messages_(&messages), on_end_(std::move(on_end)) {
    beast::error_code error;
    const auto there = beast::get_lowest_layer(socket_).socket().remote_endpoint(error);
    if (!error) {
      name_ = there.address().to_string() + ":" + std::to_string(there.port());
    }
  }

  ~Client() {
    if (left_out_ > 0) {
      std::cerr << "iog: Foxglove client " + name_ + ": " + words_of_losses() + "\n";
    }
    on_end_();
  }

  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void run(const Request& request, const std::string& server_info) {
    beast::get_lowest_layer(socket_).expires_never();
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().set_option(
        asio::socket_base::send_buffer_size(kSendBufferBytes), ignored);
    auto limits = websocket::stream_base::timeout::suggested(beast::role_type::server);
    limits.idle_timeout = kClientPatience;
    limits.keep_alive_pings = true;
    socket_.set_option(limits);
    socket_.set_option(websocket::stream_base::decorator(
        [chosen = subprotocol_of(request)](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, {chosen.data(), chosen.size()});
        }));
    socket_.read_message_max(kMaxRequestBytes);
    socket_.auto_fragment(false);
    note_frames_without_use();
    texts_.push_back(server_info);
    texts_.push_back(foxglove::advertise(messages_->channels()));
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) {
        self->is_open_ = true;
        self->read();
        self->send();
      }
    });
  }

  // Channels have changed, or a frame has come.
  void take_news(const foxglove::FrameMessages::Changes& changes) {
    if (!changes.gone.empty()) {
      for (const Channel& channel : changes.gone) {
        subscriptions_.forget(channel.id);
      }
      texts_.push_back(foxglove::unadvertise(changes.gone));
    }
    if (!changes.added.empty()) {
      texts_.push_back(foxglove::advertise(changes.added));
    }
    if (texts_.size() > kMaxTexts) {
      is_open_ = false;
      beast::get_lowest_layer(socket_).close();
      return;
    }
    note_frames_without_use();
    send();
  }

 private:
  // A client gets the frames that come after its first request; those before are not left out.
  void note_frames_without_use() {
    if (subscriptions_.is_empty()) {
      last_frame_ = messages_->frame_number();
      is_first_ = true;
    }
  }

  // One request at a time: who asks faster than it listens waits.
  void read() {
    socket_.async_read(incoming_,
                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) {
                           self->is_open_ = false;
                           return;
                         }
                         self->take_request();
                       });
  }

  void take_request() {
    const auto* const data = static_cast<const char*>(incoming_.data().data());
    const std::string_view text(data, incoming_.size());
    std::vector<std::string> answers =
        socket_.got_text() ? subscriptions_.take_text(text, messages_->channels())
                           : foxglove::Subscriptions::take_binary(std::as_bytes(std::span(text)));
    incoming_.clear();
    std::ranges::move(answers, std::back_inserter(texts_));
    waits_to_read_ = !texts_.empty();
    if (!waits_to_read_) {
      read();
    }
    send();
  }

  // What is next, if nothing is being written: words before messages, and a frame to its end before
  // another one.
  void send() {
    if (!is_open_ || is_writing_) {
      return;
    }
    if (texts_.empty() && std::exchange(waits_to_read_, false)) {
      read();
    }
    if (under_way_.empty()) {
      take_newest_frame();
    }
    if (!texts_.empty()) {
      socket_.text(true);
      write(asio::buffer(texts_.front()), [](Client& self) { self.texts_.pop_front(); });
      return;
    }
    drop_unsubscribed();
    if (!under_way_.empty()) {
      const foxglove::ChannelMessage& message = under_way_.front();
      head_ =
          foxglove::message_head(*subscriptions_.of_channel(message.channel), message.arrival_ns);
      const std::array<asio::const_buffer, 2> parts{asio::buffer(head_),
                                                    asio::buffer(*message.bytes)};
      socket_.binary(true);
      write(parts, [](Client& self) { self.under_way_.pop_front(); });
    }
  }

  template <typename Buffers>
  void write(const Buffers& buffers, void (*then)(Client&)) {
    is_writing_ = true;
    socket_.async_write(buffers,
                        [self = shared_from_this(), then](beast::error_code error, std::size_t) {
                          self->is_writing_ = false;
                          if (error) {
                            self->is_open_ = false;
                            return;
                          }
                          then(*self);
                          self->send();
                        });
  }

  void take_newest_frame() {
    const std::uint64_t newest = messages_->frame_number();
    if (newest <= last_frame_ || subscriptions_.is_empty()) {
      return;
    }
    std::set<std::uint32_t> wanted;
    for (const Channel& channel : messages_->channels()) {
      if (subscriptions_.of_channel(channel.id)) {
        wanted.insert(channel.id);
      }
    }
    std::ranges::move(messages_->of_channels(wanted), std::back_inserter(under_way_));
    left_out_ += std::exchange(is_first_, false) ? 0 : newest - last_frame_ - 1;
    last_frame_ = newest;
    ++sent_;
    tell_losses();
  }

  // The client may have changed its mind while the frame was under way.
  void drop_unsubscribed() {
    while (!under_way_.empty() && !subscriptions_.of_channel(under_way_.front().channel)) {
      under_way_.pop_front();
    }
  }

  void tell_losses() {
    const Clock::time_point now = Clock::now();
    if (left_out_ > told_ && now - last_told_ >= kTellEvery) {
      told_ = left_out_;
      last_told_ = now;
      texts_.push_back(foxglove::status(foxglove::Level::kWarning, words_of_losses(), "left out"));
    }
  }

  [[nodiscard]] std::string words_of_losses() const {
    return std::to_string(left_out_) + " frames left out and " + std::to_string(sent_) +
           " sent: its connection, or who reads there, is too slow for all";
  }

  websocket::stream<beast::tcp_stream> socket_;
  foxglove::FrameMessages* messages_;
  std::function<void()> on_end_;
  std::string name_ = "of an unknown address";
  foxglove::Subscriptions subscriptions_;
  beast::flat_buffer incoming_;
  std::deque<std::string> texts_;
  std::deque<foxglove::ChannelMessage> under_way_;  // of one frame
  foxglove::MessageHead head_{};                    // of the message that is being written
  std::uint64_t last_frame_ = 0;                    // that it got, or has not asked for
  bool is_first_ = true;                            // the next frame that it gets
  std::uint64_t sent_ = 0;                          // frames
  std::uint64_t left_out_ = 0;                      // likewise
  std::uint64_t told_ = 0;                          // of these
  Clock::time_point last_told_;
  bool is_open_ = false;
  bool is_writing_ = false;
  bool waits_to_read_ = false;  // until all answers are written
};

class FoxgloveServer : public Server {
 public:
  FoxgloveServer(const std::string& address, std::uint16_t port, foxglove::LiveFeed& feed,
                 std::function<void()> on_client)
      : feed_(&feed),
        on_client_(std::move(on_client)),
        server_info_(foxglove::server_info("iog view", std::to_string(time_of_day_us()))),
        door_(address, port,
              {.answer =
                   [this](const Request& request) {
                     return answer(request, clients_.size() < kMaxClients);
                   },
               .let_in = [this](beast::tcp_stream&& stream,
                                const Request& request) { let_in(std::move(stream), request); }}) {
    feed.on_news([this] { door_.call([this] { take_news(); }); });
    door_.open();
  }

  ~FoxgloveServer() override { feed_->on_news(nullptr); }
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  [[nodiscard]] std::uint16_t port() const override { return door_.port(); }

 private:
  void let_in(beast::tcp_stream&& stream, const Request& request) {
    const auto client =
        std::make_shared<Client>(std::move(stream), messages_, [this] { note_end(); });
    clients_.push_back(client);
    feed_->listen(true);
    client->run(request, server_info_);
    on_client_();
  }

  void note_end() {
    std::erase_if(clients_, [](const auto& client) { return client.expired(); });
    feed_->listen(!clients_.empty());
  }

  void take_news() {
    const foxglove::FrameMessages::Changes changes = messages_.take(feed_->newest());
    const std::vector<std::weak_ptr<Client>> clients = clients_;  // which may end meanwhile
    for (const std::weak_ptr<Client>& each : clients) {
      if (const std::shared_ptr<Client> client = each.lock()) {
        client->take_news(changes);
      }
    }
  }

  foxglove::LiveFeed* feed_;
  std::function<void()> on_client_;
  std::string server_info_;
  foxglove::FrameMessages messages_;
  std::vector<std::weak_ptr<Client>> clients_;
  HttpDoor door_;
};

}  // namespace

std::unique_ptr<Server> serve_foxglove(const std::string& address, std::uint16_t port,
                                       foxglove::LiveFeed& feed, std::function<void()> on_client) {
  return std::make_unique<FoxgloveServer>(address, port, feed, std::move(on_client));
}

}  // namespace iog::tools::view
