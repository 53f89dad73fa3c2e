#include "tools/view/http_door.hpp"

#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <memory>
#include <utility>

#include "tools/program/exit_status.hpp"

namespace iog::tools::view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;

constexpr std::chrono::seconds kRequestPatience{30};  // with a browser that asks nothing
constexpr std::chrono::milliseconds kPause{100};      // when nobody can be let in

// Its keeper outlives it: the door's context ends before the keeper does.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket&& socket, const Doorkeeper& keeper)
      : stream_(std::move(socket)), keeper_(&keeper) {}

  void read() {
    parser_.emplace();
    parser_->body_limit(0);
    stream_.expires_after(kRequestPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) {
                         self->serve(self->parser_->release());
                       }
                     });
  }

 private:
  void serve(const Request& request) {
    std::optional<Response> response = keeper_->answer(request);
    if (response) {
      write(request, std::move(*response));
    } else {
      keeper_->let_in(std::move(stream_), request);
    }
  }

  void write(const Request& request, Response response) {
    response_ = std::move(response);
    response_.set(http::field::server, "iog view");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set(http::field::cache_control, "no-store");
    response_.keep_alive(request.keep_alive());
    response_.prepare_payload();
    if (request.method() == http::verb::head) {
      response_.body().clear();
    }
    http::async_write(stream_, response_,
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (!error && self->response_.keep_alive()) {
                          self->read();
                        }
                      });
  }

  beast::tcp_stream stream_;
  const Doorkeeper* keeper_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  Response response_;
};

}  // namespace

Response plain_answer(const Request& request, http::status status, std::string words) {
  Response response{status, request.version()};
  response.set(http::field::content_type, "text/plain; charset=utf-8");
  response.body() = std::move(words);
  return response;
}

HttpDoor::HttpDoor(const std::string& address, std::uint16_t port, Doorkeeper keeper)
    : keeper_(std::move(keeper)), acceptor_(context_), pause_(context_) {
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
}

HttpDoor::~HttpDoor() {
  context_.stop();
  if (thread_.joinable()) {
    thread_.join();
  }
}

void HttpDoor::open() {
  thread_ = std::thread([this] { context_.run(); });
}

void HttpDoor::call(std::function<void()> what) { asio::post(context_, std::move(what)); }

void HttpDoor::accept() {
  acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error) {
      accept_later();
      return;
    }
    socket.set_option(tcp::no_delay(true), error);
    std::make_shared<Connection>(std::move(socket), keeper_)->read();
    accept();
  });
}

// The file descriptors are used up. Who waits at the door is still there, so to ask again at once
// would be a loop without rest.
void HttpDoor::accept_later() {
  pause_.expires_after(kPause);
  pause_.async_wait([this](beast::error_code error) {
    if (!error) {
      accept();
    }
  });
}

}  // namespace iog::tools::view
