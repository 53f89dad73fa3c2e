// A page acknowledges each message that it has dealt with; two may be under way. So what a page
// shows is never older than that, however slow it or the network is.
#include <algorithm>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tools/view/http_door.hpp"
#include "tools/view/literal_host.hpp"
#include "tools/view/page_files.hpp"
#include "tools/view/servers.hpp"

namespace iog::tools::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::chrono::seconds kPagePatience{30};  // with a page that says nothing
constexpr std::size_t kMaxPages = 16;              // open at the same time
constexpr std::size_t kMaxWordBytes = 64;          // what a page has to say is a word
constexpr int kMessagesUnderWay = 2;

// Nothing but our own files, no frames, no forms; nothing is kept, so that a page and the program
// that serves it are always of one version.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

Response binary_answer(const Request& request, std::span<const std::uint8_t> bytes) {
  Response response{http::status::ok, request.version()};
  response.set(http::field::content_type, "application/octet-stream");
  response.body().assign(bytes.begin(), bytes.end());
  return response;
}

Response file_answer(const Request& request, const Scene& scene) {
  if (!is_literal_host(text_of(request[http::field::host]))) {
    return plain_answer(request, http::status::forbidden,
                        "Open this page by its address, such as http://127.0.0.1:8080/\n");
  }
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    return plain_answer(request, http::status::method_not_allowed, "Only GET and HEAD.\n");
  }
  if (request.target() == "/map.iogmap" && !scene.map().empty()) {
    return binary_answer(request, scene.map());
  }
  const PageFile* const file = page_file(text_of(request.target()));
  if (file == nullptr) {
    return plain_answer(request, http::status::not_found, "There is no such page.\n");
  }
  Response response{http::status::ok, request.version()};
  response.set(http::field::content_type, {file->type.data(), file->type.size()});
  response.body() = file->content;
  return response;
}

// A WebSocket of a page that came from here.
bool is_own_page(const Request& request) {
  const std::string_view host = text_of(request[http::field::host]);
  return request.target() == "/live" && is_literal_host(host) &&
         text_of(request[http::field::origin]) == "http://" + std::string(host);
}

// Nothing for a page of ours that asks for its WebSocket.
std::optional<Response> answer(const Request& request, const Scene& scene) {
  if (websocket::is_upgrade(request) && is_own_page(request)) {
    return std::nullopt;
  }
  Response response =
      websocket::is_upgrade(request)
          ? plain_answer(request, http::status::forbidden, "Only for pages of this server.\n")
          : file_answer(request, scene);
  response.set("Content-Security-Policy", kPolicy);
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  return response;
}

class LivePage : public std::enable_shared_from_this<LivePage> {
 public:
  LivePage(beast::tcp_stream&& stream, Scene& scene) : socket_(std::move(stream)), scene_(&scene) {}

  void run(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    auto limits = websocket::stream_base::timeout::suggested(beast::role_type::server);
    limits.idle_timeout = kPagePatience;
    limits.keep_alive_pings = true;
    socket_.set_option(limits);
    socket_.read_message_max(kMaxWordBytes);
    socket_.binary(true);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (!error) {
        self->is_open_ = true;
        self->scene_->note_page();
        self->read();
        self->send_news();
      }
    });
  }

  // Something new may be there.
  void send_news() {
    if (!is_open_ || is_writing_ || credit_ == 0) {
      return;
    }
    message_ = scene_->message_since(place_);
    if (message_.empty()) {
      return;
    }
    is_writing_ = true;
    --credit_;
    socket_.async_write(asio::buffer(message_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          self->is_writing_ = false;
                          if (error) {
                            self->is_open_ = false;
                          } else {
                            self->send_news();
                          }
                        });
  }

 private:
  void read() {
    socket_.async_read(incoming_,
                       [self = shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) {
                           self->is_open_ = false;
                           return;
                         }
                         self->take(beast::buffers_to_string(self->incoming_.data()));
                         self->incoming_.clear();
                         self->read();
                       });
  }

  void take(const std::string& words) {
    if (words == "ready") {
      credit_ = std::min(credit_ + 1, kMessagesUnderWay);
      send_news();
    } else {
      scene_->ask(words);
    }
  }

  websocket::stream<beast::tcp_stream> socket_;
  Scene* scene_;
  Scene::Place place_;
  beast::flat_buffer incoming_;
  std::string message_;
  int credit_ = kMessagesUnderWay;
  bool is_open_ = false;
  bool is_writing_ = false;
};

// The pages that are open, so that they can be told of news.
class Pages {
 public:
  // False if there are too many.
  bool add(const std::shared_ptr<LivePage>& page) {
    std::erase_if(pages_, [](const auto& other) { return other.expired(); });
    if (pages_.size() == kMaxPages) {
      return false;
    }
    pages_.push_back(page);
    return true;
  }

  void send_news() const {
    for (const auto& page : pages_) {
      if (const auto open = page.lock()) {
        open->send_news();
      }
    }
  }

 private:
  std::vector<std::weak_ptr<LivePage>> pages_;
};

class PageServer : public Server {
 public:
  PageServer(const std::string& address, std::uint16_t port, Scene& scene)
      : scene_(&scene),
        door_(address, port,
              {.answer = [this](const Request& request) { return answer(request, *scene_); },
               .let_in = [this](beast::tcp_stream&& stream,
                                const Request& request) { let_in(std::move(stream), request); }}) {
    scene.on_news([this] { door_.call([this] { pages_.send_news(); }); });
    door_.open();
  }

  ~PageServer() override { scene_->on_news(nullptr); }
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  [[nodiscard]] std::uint16_t port() const override { return door_.port(); }

 private:
  void let_in(beast::tcp_stream&& stream, const Request& request) {
    const auto page = std::make_shared<LivePage>(std::move(stream), *scene_);
    if (pages_.add(page)) {
      page->run(request);
    }
  }

  Scene* scene_;
  Pages pages_;
  HttpDoor door_;
};

}  // namespace

std::unique_ptr<Server> serve_page(const std::string& address, std::uint16_t port, Scene& scene) {
  return std::make_unique<PageServer>(address, port, scene);
}

}  // namespace iog::tools::view
