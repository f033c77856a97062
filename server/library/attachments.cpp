#include "server/library/attachments.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "protocol/base/utf8.hpp"
#include "protocol/process/log.hpp"
#include "server/library/programs.hpp"

namespace dripline::library {
namespace {

constexpr std::string_view kRefused = "/\\:*?\"<>|";

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

/// Windows opens a device whatever follows its name.
bool is_device(std::string_view name) {
  std::string stem(name.substr(0, name.find('.')));
  for (char& c : stem) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - ('a' - 'A')) : c;
  constexpr std::array<std::string_view, 4> kAlone{"CON", "PRN", "AUX", "NUL"};
  if (std::ranges::find(kAlone, stem) != kAlone.end()) return true;
  return stem.size() == 4 && (stem.starts_with("COM") || stem.starts_with("LPT")) &&
         stem[3] >= '0' && stem[3] <= '9';
}

/// Letters, digits and marks that need no quotation in a header.
bool is_plain(char c) {
  constexpr std::string_view kMarks = "._-+!#$&^`~";
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
         kMarks.find(c) != std::string_view::npos;
}

/// U+202E and its like show a name in another order than it has: "gpj.exe" from "exe.jpg".
bool is_direction_mark(std::string_view character) {
  static constexpr std::array<std::string_view, 11> kMarks{"\u200E", "\u200F", "\u202A", "\u202B",
                                                           "\u202C", "\u202D", "\u202E", "\u2066",
                                                           "\u2067", "\u2068", "\u2069"};
  return std::ranges::find(kMarks, character) != kMarks.end();
}

}  // namespace

Result<void> check_attachment_name(std::string_view name) {
  const std::string shown = one_line(name.substr(0, Attachments::kMaxName));
  if (name.empty()) return fail(Errc::Syntax, "the name of an attachment is empty");
  if (name.size() > Attachments::kMaxName) {
    return fail(Errc::LimitExceeded, "attachment name of {} bytes: at most {}", name.size(),
                Attachments::kMaxName);
  }
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t length = utf8_length(name.substr(at));
    if (length == 0) return fail(Errc::Syntax, "attachment name '{}' is not UTF-8", shown);
    const bool is_bad = is_control(name[at]) || kRefused.find(name[at]) != std::string_view::npos ||
                        is_direction_mark(name.substr(at, length));
    if (is_bad) {
      return fail(Errc::Syntax,
                  "attachment name '{}': no control characters and none of {} can be in it", shown,
                  kRefused);
    }
    at += length;
  }
  constexpr std::string_view kNotFirst = ". -", kNotLast = ". ";
  if (kNotFirst.find(name.front()) != std::string_view::npos ||
      kNotLast.find(name.back()) != std::string_view::npos) {
    return fail(
        Errc::Syntax,
        "attachment name '{}' begins with a dot, a dash or a blank, or ends with a dot or a "
        "blank",
        shown);
  }
  if (is_device(name))
    return fail(Errc::Syntax, "attachment name '{}' is a device of Windows", shown);
  return {};
}

std::string content_disposition(std::string_view name) {
  std::string plain, encoded;
  for (const char c : name) {
    plain += is_plain(c) || c == ' ' ? c : '_';
    encoded +=
        is_plain(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return fmt::format("attachment; filename=\"{}\"; filename*=UTF-8''{}", plain, encoded);
}

Result<storage::Upload> Attachments::begin(const Request& request, const storage::Actor& who) {
  if (auto good = check_attachment_name(request.name.name); !good) return fail(good.error());
  if (request.comment.size() > Programs::kMaxComment) {
    return fail(Errc::LimitExceeded, "comment of {} bytes: at most {}", request.comment.size(),
                Programs::kMaxComment);
  }
  storage::Upload upload;
  upload.program = request.name.program;
  upload.comment = request.comment;
  upload.author = who.name;
  upload.attachment = request.name.name;
  upload.attachment_revision = request.name.revision;
  return uploads_.begin(upload);
}

Result<storage::Attachment> Attachments::commit(const std::string& upload,
                                                const std::optional<Digest>& expected,
                                                const storage::Actor& who) {
  auto attached = store_.commit(upload, expected, who);
  if (attached) {
    process::log_info("attached program={} name={} size={} by={}", attached->program,
                      one_line(attached->name), attached->size, who.name);
  }
  return attached;
}

Result<void> Attachments::remove(const storage::AttachmentName& name, const storage::Actor& who) {
  auto removed = store_.remove(name, who);
  if (removed) {
    process::log_info("detached program={} name={} by={}", name.program, one_line(name.name),
                      who.name);
  }
  return removed;
}

}  // namespace dripline::library
