#include "server/api/content_body.hpp"

#include <algorithm>

namespace dripline::api {
namespace {

constexpr std::uint64_t kContentPiece = 256 * 1024;

/// Reads `range` of the content piece by piece.
BodySource content_source(Services& services, const Digest& content, ByteRange range) {
  return [&services, content, range]() mutable -> Result<std::optional<std::string>> {
    if (range.length == 0) return std::nullopt;
    const auto bytes =
        services.programs.read(content, range.first, std::min(range.length, kContentPiece));
    if (!bytes) return fail(bytes.error());
    if (bytes->empty()) return fail(Errc::Corrupt, "content {} is short", content.hex());
    range.first += bytes->size();
    range.length -= bytes->size();
    return std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  };
}

/// Reads the first piece before the head is sent, so that damage there is a clear error.
Result<BodySource> opened(BodySource source) {
  auto first = source();
  if (!first) return fail(first.error());
  auto head = std::make_shared<std::optional<std::string>>(*std::move(first));
  return [head, source = std::move(source)]() -> Result<std::optional<std::string>> {
    if (!*head) return source();
    std::string text = *std::exchange(*head, std::nullopt);
    return text;
  };
}

Response unsatisfiable(const Error& error, std::uint64_t size) {
  constexpr int kRangeNotSatisfiable = 416;
  if (error.code != Errc::LimitExceeded) return error_response(error);
  Response response = error_response(kRangeNotSatisfiable, error);
  response.headers.emplace_back("Content-Range", fmt::format("bytes */{}", size));
  return response;
}

}  // namespace

Response content_response(Services& services, const Request& request,
                          const StoredContent& content) {
  const auto range = parse_byte_range(request.header("range"), content.size);
  if (!range) return unsatisfiable(range.error(), content.size);
  const ByteRange wanted = range->value_or(ByteRange{.first = 0, .length = content.size});
  auto source = opened(content_source(services, content.digest, wanted));
  if (!source) return error_response(source.error());
  Response response;
  response.content_type = "application/octet-stream";
  response.source = *std::move(source);
  response.source_length = wanted.length;
  response.headers = {{"Accept-Ranges", "bytes"}};
  if (*range) {
    constexpr int kPartialContent = 206;
    response.status = kPartialContent;
    response.headers.emplace_back("Content-Range",
                                  fmt::format("bytes {}-{}/{}", wanted.first,
                                              wanted.first + wanted.length - 1, content.size));
  }
  return response;
}

}  // namespace dripline::api
