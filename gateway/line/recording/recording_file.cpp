#include "gateway/line/recording/recording_file.hpp"

#include <charconv>
#include <nlohmann/json.hpp>

namespace dripline::line {
namespace {

std::string to_hex(std::string_view bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string hex;
  hex.reserve(bytes.size() * 2);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    hex += kDigits[byte >> 4U];
    hex += kDigits[byte & 0xFU];
  }
  return hex;
}

int digit_value(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

Result<std::string> from_hex(std::string_view hex) {
  std::string bytes;
  if (hex.size() % 2 != 0) return fail(Errc::Syntax, "hex of {} digits", hex.size());
  for (std::size_t i = 0; i < hex.size(); i += 2) {
    const int high = digit_value(hex[i]);
    const int low = digit_value(hex[i + 1]);
    if (high < 0 || low < 0) return fail(Errc::Syntax, "'{}' is not hex", hex.substr(i, 2));
    bytes += static_cast<char>(high * 16 + low);
  }
  return bytes;
}

/// The reverse of to_iso8601.
Result<UtcTime> parse_time(std::string_view text) {
  constexpr std::string_view kShape = "0000-00-00T00:00:00.000000Z";
  if (text.size() != kShape.size()) return fail(Errc::Syntax, "'{}' is no time", text);
  const auto number = [&](std::size_t from, std::size_t size) {
    int value = -1;
    std::from_chars(text.data() + from, text.data() + from + size, value);
    return value;
  };
  const std::chrono::year_month_day day{std::chrono::year{number(0, 4)},
                                        std::chrono::month{static_cast<unsigned>(number(5, 2))},
                                        std::chrono::day{static_cast<unsigned>(number(8, 2))}};
  if (!day.ok()) return fail(Errc::Syntax, "'{}' is no time", text);
  return UtcTime{std::chrono::sys_days{day}} + std::chrono::hours{number(11, 2)} +
         std::chrono::minutes{number(14, 2)} + std::chrono::seconds{number(17, 2)} +
         std::chrono::microseconds{number(20, 6)};
}

/// A member that must be there as a string; nullptr: it is not.
const std::string* text_of(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? &found->get_ref<const std::string&>()
                                                   : nullptr;
}

void read_file(const std::filesystem::path& path, std::vector<PortTraffic>& entries) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (auto entry = parse_recording_line(line)) entries.push_back(*std::move(entry));
  }
}

}  // namespace

std::string to_recording_line(const PortTraffic& entry) {
  const nlohmann::json json{{"port", entry.port},
                            {"time", to_iso8601(entry.time)},
                            {"what", to_string(entry.what)},
                            {"bytes", to_hex(entry.bytes)},
                            {"text", entry.text}};
  return json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

Result<PortTraffic> parse_recording_line(std::string_view line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) return fail(Errc::Syntax, "not a line of a recording");
  const auto* port = text_of(json, "port");
  const auto* time = text_of(json, "time");
  const auto* what = text_of(json, "what");
  const auto* bytes = text_of(json, "bytes");
  const auto* text = text_of(json, "text");
  if (!port || !time || !what || !bytes || !text) {
    return fail(Errc::Syntax, "a line of a recording has port, time, what, bytes and text");
  }
  const auto kind = parse_traffic_kind(*what);
  if (!kind) return fail(kind.error());
  const auto when = parse_time(*time);
  if (!when) return fail(when.error());
  auto characters = from_hex(*bytes);
  if (!characters) return fail(characters.error());
  return PortTraffic{
      .port = *port, .time = *when, .what = *kind, .bytes = *std::move(characters), .text = *text};
}

RecordingFile::RecordingFile(const std::filesystem::path& folder, const std::string& port)
    : current_(folder / (port + ".jsonl")), old_(folder / (port + ".old.jsonl")) {}

std::vector<PortTraffic> RecordingFile::read() const {
  std::vector<PortTraffic> entries;
  read_file(old_, entries);
  read_file(current_, entries);
  return entries;
}

Result<void> RecordingFile::open() {
  std::error_code ec;
  std::filesystem::create_directories(current_.parent_path(), ec);
  size_ = std::filesystem::exists(current_, ec) ? std::filesystem::file_size(current_, ec) : 0;
  if (size_ >= kMaxFile) {
    std::filesystem::rename(current_, old_, ec);
    size_ = 0;
  }
  out_ = std::ofstream(current_, std::ios::binary | std::ios::app);
  if (!out_) return fail(Errc::Io, "recording '{}' cannot be written", current_.string());
  // A line that a kill cut off ends here and spoils no other.
  if (size_ > 0) out_ << '\n';
  return {};
}

Result<void> RecordingFile::write(const std::vector<PortTraffic>& entries) {
  for (const auto& entry : entries) {
    if (!out_.is_open() || size_ >= kMaxFile) {
      out_.close();
      if (auto opened = open(); !opened) return opened;
    }
    const std::string line = to_recording_line(entry) + "\n";
    out_ << line;
    size_ += line.size();
  }
  out_.flush();
  if (out_) return {};
  out_.close();
  return fail(Errc::Io, "recording '{}' cannot be written", current_.string());
}

}  // namespace dripline::line
