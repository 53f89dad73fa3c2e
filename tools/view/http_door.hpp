// Waits at a port for HTTP requests, answers them, and lets in who asks for a WebSocket.
// Boost.Beast; everything is asynchronous, on the door's own thread. A connection keeps itself
// alive by the operations that wait for it, and ends with them.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace iog::tools::view {

using Request = boost::beast::http::request<boost::beast::http::empty_body>;
using Response = boost::beast::http::response<boost::beast::http::string_body>;

[[nodiscard]] inline std::string_view text_of(boost::beast::string_view words) {
  return {words.data(), words.size()};
}

[[nodiscard]] Response plain_answer(const Request& request, boost::beast::http::status status,
                                    std::string words);

struct Doorkeeper {
  // Nothing: a request for a WebSocket, which is let in.
  std::function<std::optional<Response>(const Request&)> answer;
  std::function<void(boost::beast::tcp_stream&&, const Request&)> let_in;
};

class HttpDoor {
 public:
  // Port 0: any free one. UsageError if that address and port cannot be had. Nobody is asked in
  // before open().
  HttpDoor(const std::string& address, std::uint16_t port, Doorkeeper keeper);
  // Connections end before it returns.
  ~HttpDoor();
  HttpDoor(const HttpDoor&) = delete;
  HttpDoor& operator=(const HttpDoor&) = delete;

  void open();
  // On the door's thread.
  void call(std::function<void()> what);
  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  void accept();
  void accept_later();

  Doorkeeper keeper_;
  boost::asio::io_context context_{1};
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
  std::thread thread_;
};

}  // namespace iog::tools::view
