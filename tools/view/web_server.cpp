// Boost.Beast, one thread, everything asynchronous. A connection keeps itself alive by the
// operations that wait for it, and ends with them.
//
// A page acknowledges each message that it has dealt with; two may be under way. So what a page
// shows is never older than that, however slow it or the network is.
#include "tools/view/web_server.hpp"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <memory>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "tools/program/exit_status.hpp"
#include "tools/view/literal_host.hpp"
#include "tools/view/page_files.hpp"

namespace iog::tools::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;

constexpr std::chrono::seconds kPatience{30};     // with a browser that asks nothing
constexpr std::chrono::milliseconds kPause{100};  // when nobody can be let in
constexpr std::size_t kMaxPages = 16;             // open at the same time
constexpr std::size_t kMaxRequestBytes = 64;      // what a page has to say is a word
constexpr int kMessagesUnderWay = 2;

// Nothing but our own files, no frames, no forms; nothing is kept, so that a page and the program
// that serves it are always of one version.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view text_of(beast::string_view words) { return {words.data(), words.size()}; }

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

Response plain_answer(const Request& request, http::status status, std::string words) {
  Response response{status, request.version()};
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.body() = std::move(words);
  return response;
}

Response binary_answer(const Request& request, std::span<const std::uint8_t> bytes) {
  Response response{http::status::ok, request.version()};
  response.set(http::field::content_type, "application/octet-stream");
  response.body().assign(bytes.begin(), bytes.end());
  return response;
}

Response answer(const Request& request, const Scene& scene) {
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

Response complete(const Request& request, Response response) {
  response.set(http::field::server, "iog view");
  response.set("Content-Security-Policy", kPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
  response.keep_alive(request.keep_alive());
  response.prepare_payload();
  if (request.method() == http::verb::head) {
    response.body().clear();
  }
  return response;
}

// A WebSocket of a page that came from here.
bool is_own_page(const Request& request) {
  const std::string_view host = text_of(request[http::field::host]);
  return request.target() == "/live" && is_literal_host(host) &&
         text_of(request[http::field::origin]) == "http://" + std::string(host);
}

class LivePage : public std::enable_shared_from_this<LivePage> {
 public:
  LivePage(beast::tcp_stream&& stream, Scene& scene) : socket_(std::move(stream)), scene_(&scene) {}

  void run(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    auto limits = websocket::stream_base::timeout::suggested(beast::role_type::server);
    limits.idle_timeout = kPatience;
    limits.keep_alive_pings = true;
    socket_.set_option(limits);
    socket_.read_message_max(kMaxRequestBytes);
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

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket&& socket, Scene& scene, Pages& pages)
      : stream_(std::move(socket)), scene_(&scene), pages_(&pages) {}

  void read() {
    parser_.emplace();
    parser_->body_limit(0);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) {
                         self->serve(self->parser_->release());
                       }
                     });
  }

 private:
  void serve(const Request& request) {
    if (!websocket::is_upgrade(request)) {
      write(complete(request, answer(request, *scene_)));
      return;
    }
    if (!is_own_page(request)) {
      write(complete(request, plain_answer(request, http::status::forbidden,
                                           "Only for pages of this server.\n")));
      return;
    }
    const auto page = std::make_shared<LivePage>(std::move(stream_), *scene_);
    if (pages_->add(page)) {
      page->run(request);
    }
  }

  void write(Response response) {
    response_ = std::move(response);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (!error && self->response_.keep_alive()) {
                          self->read();
                        }
                      });
  }

  beast::tcp_stream stream_;
  Scene* scene_;
  Pages* pages_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  Response response_;
};

}  // namespace

class WebServer::Implementation {
 public:
  Implementation(const std::string& address, std::uint16_t port, Scene& scene)
      : scene_(&scene), acceptor_(context_) {
    beast::error_code error;
    const tcp::endpoint here{asio::ip::make_address(address, error), port};
    if (error) {
      throw UsageError("--http-bind " + address + ": give an IP address such as 127.0.0.1");
    }
    acceptor_.open(here.protocol());
    acceptor_.set_option(asio::socket_base::reuse_address(true));
    acceptor_.bind(here, error);
    if (error) {
      throw UsageError("cannot serve on " + address + ":" + std::to_string(port) + ": " +
                       error.message());
    }
    acceptor_.listen();
    accept();
    scene.on_news([this] { asio::post(context_, [this] { pages_.send_news(); }); });
    thread_ = std::thread([this] { context_.run(); });
  }

  ~Implementation() {
    scene_->on_news(nullptr);
    context_.stop();
    thread_.join();
  }

  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error) {
        accept_later();
        return;
      }
      socket.set_option(tcp::no_delay(true), error);
      std::make_shared<Connection>(std::move(socket), *scene_, pages_)->read();
      accept();
    });
  }

  // The file descriptors are used up. Who waits at the door is still there, so to ask again at once
  // would be a loop without rest.
  void accept_later() {
    pause_.expires_after(kPause);
    pause_.async_wait([this](beast::error_code error) {
      if (!error) {
        accept();
      }
    });
  }

  Scene* scene_;
  Pages pages_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pause_{context_};
  std::thread thread_;
};

WebServer::WebServer(const std::string& address, std::uint16_t port, Scene& scene)
    : implementation_(std::make_unique<Implementation>(address, port, scene)) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const { return implementation_->port(); }

}  // namespace iog::tools::view
