#include "server/api/impl/body_reader.hpp"

#include <algorithm>

#include "server/api/impl/http_head.hpp"

namespace dripline::api {
namespace {

using namespace std::chrono_literals;
namespace http = boost::beast::http;
using boost::asio::awaitable;
using boost::system::error_code;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kSlowestBody = 4096;  ///< bytes a second, over a whole body
constexpr auto kBodyGrace = 30s;

std::optional<Response> client_gone() {
  Response response;
  response.status = 0;
  return response;
}

}  // namespace

std::uint64_t BodyReader::limit_of(const Request& head) const {
  const auto& limit = parts_.shared.handlers.max_body;
  const std::uint64_t most = parts_.shared.options.max_body;
  return limit ? std::min(limit(head), most) : most;
}

awaitable<std::optional<Response>> BodyReader::read(RequestReader::Parser& parser,
                                                    const Request& head, BodyMemory::Share& share) {
  const std::uint64_t most = limit_of(head);
  const auto length = parser.content_length();
  if (length && *length > most) {
    co_return refusal(413, Errc::LimitExceeded,
                      fmt::format("a body of {} bytes: at most {}", *length, most));
  }
  if (most == 0) co_return refusal(413, Errc::LimitExceeded, "a body where none is taken");
  parser.body_limit(most);
  const std::uint64_t size = length ? *length : most;
  const bool is_taken = co_await take_memory(size, head.who.name, share);
  if (!is_taken) co_return refusal(503, Errc::Busy, "too many bodies are being received at once");
  const HttpLimits& limits = parts_.shared.options.limits;
  if (parser.get()[http::field::expect] == "100-continue") {
    const bool is_told =
        co_await parts_.transport.write("HTTP/1.1 100 Continue\r\n\r\n", limits.write);
    if (!is_told) co_return client_gone();
  }
  const auto end = Clock::now() + kBodyGrace + std::chrono::seconds(size / kSlowestBody);
  const error_code error = co_await parts_.reader.read_body(parser, limits.body, end);
  if (!error) co_return std::nullopt;
  const auto refused = refusal_of(error);
  co_return refused ? refused : client_gone();
}

awaitable<bool> BodyReader::take_memory(std::uint64_t size, const std::string& caller,
                                        BodyMemory::Share& share) {
  BodyMemory& memory = parts_.shared.body_memory;
  const auto end = Clock::now() + parts_.shared.options.limits.body;
  const auto waiter = memory.wait([&woken = parts_.woken] { woken.set(); });
  while (!memory.has(size, caller) && may_continue() && Clock::now() < end) {
    co_await parts_.woken.wait(end);
  }
  memory.remove(waiter);
  if (!may_continue() || !memory.has(size, caller)) co_return false;
  share = memory.take(size, caller);
  co_return true;
}

}  // namespace dripline::api
