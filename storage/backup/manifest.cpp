#include "storage/backup/manifest.hpp"

#include <nlohmann/json.hpp>

#include "storage/programs/chunk_codec.hpp"

namespace dripline::backup {
namespace {

constexpr int kFormat = 1;

using Json = nlohmann::json;

Json files_json(const Manifest& manifest) {
  auto files = Json::array();
  for (const auto& file : manifest.files) {
    auto chunks = Json::array();
    for (const auto& chunk : file.chunks) chunks.push_back(chunk.hex());
    files.push_back({{"name", file.name}, {"size", file.size}, {"chunks", std::move(chunks)}});
  }
  return files;
}

Json body_json(const Manifest& manifest) {
  return {{"format", kFormat},           {"made_us", manifest.made.time_since_epoch().count()},
          {"made_by", manifest.made_by}, {"database", manifest.database},
          {"added", manifest.added},     {"files", files_json(manifest)}};
}

/// A name that stays within its folder.
bool is_plain(const std::string& name) {
  constexpr std::size_t kLongest = 255;
  return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
         name.find('/') == std::string::npos && name.find('\0') == std::string::npos;
}

std::uint64_t chunks_of(std::uint64_t size) {
  return size / storage::kChunkBytes + (size % storage::kChunkBytes == 0 ? 0 : 1);
}

Result<KeptFile> read_file(const Json& json) {
  KeptFile file{.name = json.at("name").get<std::string>(),
                .size = json.at("size").get<std::uint64_t>(),
                .chunks = {}};
  if (!is_plain(file.name)) return fail(Errc::Corrupt, "file name '{}'", file.name);
  for (const auto& chunk : json.at("chunks")) {
    const auto digest = parse_digest(chunk.get_ref<const std::string&>());
    if (!digest) return fail(Errc::Corrupt, "file {}: {}", file.name, digest.error().what);
    file.chunks.push_back(*digest);
  }
  if (file.chunks.size() != chunks_of(file.size)) {
    return fail(Errc::Corrupt, "file {}: {} chunks for {} bytes", file.name, file.chunks.size(),
                file.size);
  }
  return file;
}

Result<Manifest> read_body(const Json& json) {
  Manifest manifest;
  manifest.made = UtcTime(std::chrono::microseconds(json.at("made_us").get<std::int64_t>()));
  manifest.made_by = json.at("made_by").get<std::string>();
  manifest.database = json.at("database").get<std::string>();
  manifest.added = json.at("added").get<std::uint64_t>();
  for (const auto& item : json.at("files")) {
    auto file = read_file(item);
    if (!file) return fail(file.error());
    manifest.files.push_back(*std::move(file));
  }
  return manifest;
}

}  // namespace

std::uint64_t Manifest::size() const {
  std::uint64_t sum = 0;
  for (const auto& file : files) sum += file.size;
  return sum;
}

std::string to_text(const Manifest& manifest) {
  Json json = body_json(manifest);
  json["digest"] = sha256(json.dump()).hex();
  return json.dump() + "\n";
}

Result<Manifest> parse_manifest(std::string_view text) {
  try {
    Json json = Json::parse(text);
    const int format = json.at("format").get<int>();
    if (format > kFormat)
      return fail(Errc::Unsupported, "format {}: this version reads {}", format, kFormat);
    const auto digest = json.at("digest").get<std::string>();
    json.erase("digest");
    if (sha256(json.dump()).hex() != digest)
      return fail(Errc::Corrupt, "its digest does not belong to its text");
    return read_body(json);
  } catch (const Json::exception& failure) {
    return fail(Errc::Corrupt, "{}", failure.what());
  }
}

}  // namespace dripline::backup
