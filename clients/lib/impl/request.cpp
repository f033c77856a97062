#include "clients/lib/impl/request.hpp"

#include <nlohmann/json.hpp>

#include "clients/lib/client.hpp"

namespace dripline::client::impl {

HttpRequest get(std::string path) {
  HttpRequest request;
  request.path = std::move(path);
  return request;
}

HttpRequest get_part(std::string path, std::uint64_t offset, std::uint64_t length) {
  constexpr std::uint64_t kMaxErrorText = 4096;
  HttpRequest request = get(std::move(path));
  request.headers.emplace_back("Range", fmt::format("bytes={}-{}", offset, offset + length - 1));
  request.max_body = std::max(length, kMaxErrorText);
  return request;
}

HttpRequest with_method(std::string method, std::string path) {
  HttpRequest request = get(std::move(path));
  request.method = std::move(method);
  return request;
}

std::string path_of(std::string_view collection) {
  return std::string("/api/v1/") + std::string(collection);
}

std::string path_of(std::string_view collection, std::string_view item) {
  return path_of(collection) + "/" + url_encode(item);
}

std::string with_query(std::string path, std::string_view key, std::string_view value) {
  if (value.empty()) return path;
  path += path.find('?') == std::string::npos ? '?' : '&';
  path += key;
  path += '=';
  return path + url_encode(value);
}

std::string with_number(std::string path, std::string_view key,
                        std::optional<std::uint64_t> number) {
  return number ? with_query(std::move(path), key, std::to_string(*number)) : path;
}

std::string with_page(std::string path, const Page& page) {
  return with_number(with_number(std::move(path), "limit", page.limit), "offset", page.offset);
}

std::string dumped(const nlohmann::json& body) {
  return body.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace dripline::client::impl
