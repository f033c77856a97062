#include "protocol/archive/archive_entry.hpp"

#include <array>
#include <fstream>
#include <span>

namespace dripline::archive {

std::optional<Digest> digest_in(std::string_view detail) {
  constexpr std::string_view kWord = ", sha256 ";
  const auto at = detail.rfind(kWord);
  if (at == std::string_view::npos) return std::nullopt;
  const auto read = parse_digest(detail.substr(at + kWord.size()));
  return read ? std::optional(*read) : std::nullopt;
}

Result<Digest> digest_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail(Errc::Io, "it cannot be opened");
  Sha256 digest;
  std::array<char, 64 * 1024> buffer{};
  while (file) {
    file.read(buffer.data(), buffer.size());
    digest.update(std::as_bytes(std::span(buffer).first(static_cast<std::size_t>(file.gcount()))));
  }
  if (!file.eof()) return fail(Errc::Io, "it cannot be read");
  return digest.digest();
}

}  // namespace dripline::archive
