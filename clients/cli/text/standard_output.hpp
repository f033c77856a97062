#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/context.hpp"
#include "clients/cli/text/terminal_text.hpp"
#include "clients/lib/api_json.hpp"
#include "clients/lib/reply.hpp"

namespace dripline::cli {

/// What standard output gets.
enum class Content {
  Data,  ///< programs, reports, CSV, JSON: unchanged in a pipe or file, visible on a terminal
  Text,  ///< for people: visible everywhere, for a pipe may end at a terminal
  Raw,   ///< unchanged, on a terminal too, because the user asked for it
};

/// Standard output for content of any length: unbuffered, and it notices when there is no reader
/// any more. After a failed write nothing more is written.
class StandardOutput {
 public:
  explicit StandardOutput(Content content = Content::Data);
  /// Errors: Io.
  Result<void> write(std::string_view text);
  const std::optional<Error>& error() const { return error_; }
  /// The reader has gone (`dnc ... | head`): no error to speak of.
  bool is_closed() const { return is_closed_; }
  /// After a failed write: reports it, unless the reader has gone, and returns the exit status.
  int complain() const;

 private:
  void write_bytes(std::string_view bytes);
  std::optional<VisibleText> visible_;  ///< unset: everything is written unchanged
  std::optional<Error> error_;
  bool is_closed_ = false;
};

/// The whole file or none of it. Errors: Io.
Result<void> write_file(const std::string& path, std::string_view bytes);

/// Writes to a file, or to standard output for "-" and "". Gives the exit status.
int write_to(const std::string& path, std::string_view text, Content content = Content::Data);

/// The whole file or none of it, piece by piece as `fetch` passes them to its argument; "-" and "":
/// to standard output. Gives the exit status.
using ContentSink = std::function<bool(std::string_view)>;
int save_content(const std::string& path,
                 const std::function<client::Reply<void>(const ContentSink&)>& fetch);

/// JSON for `--json`: indented, with a line end; invalid UTF-8 is replaced.
inline std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// One object on one line, for streams of them.
inline std::string json_line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

template <class T>
std::string json_text(const T& value) {
  return json_text(client::to_json_value(value));
}

/// `{"NAME": [...]}`, as the server's listings are.
template <class T>
std::string json_list_text(const char* name, const std::vector<T>& list) {
  auto array = nlohmann::ordered_json::array();
  for (const auto& item : list) array.push_back(client::to_json_value(item));
  return json_text(nlohmann::ordered_json{{name, std::move(array)}});
}

/// The exit status, when nothing is left to be printed: the call failed, or `reply` was printed as
/// JSON.
template <class T>
std::optional<int> finished(const Context& context, const client::Reply<T>& reply) {
  if (!reply) return complain(reply.error());
  if (!context.wants_json) return std::nullopt;
  context.print(json_text(*reply));
  return kExitOk;
}

/// The same for a listing, `{"NAME": [...]}`.
template <class T>
std::optional<int> finished(const Context& context, const client::Reply<std::vector<T>>& reply,
                            const char* name) {
  if (!reply) return complain(reply.error());
  if (!context.wants_json) return std::nullopt;
  context.print(json_list_text(name, *reply));
  return kExitOk;
}

}  // namespace dripline::cli
