#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "server/identity/caller.hpp"

namespace dripline::api {

/// The path and the query of a request line, split before percent-decoding, so that a decoded slash
/// stays inside its segment.
struct Target {
  std::vector<std::string> segments;
  std::map<std::string, std::string> query;
};
/// Errors: Syntax (no leading slash, bad escape, NUL, a query name twice), LimitExceeded (longer
/// than kMaxTarget).
Result<Target> parse_target(std::string_view text);
inline constexpr std::size_t kMaxTarget = 4096;

struct Request {
  std::string method;  ///< GET, POST, PUT, DELETE ...
  Target target;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
  std::map<std::string, std::string> parameters;  ///< `{name}` of the route; set by the router
  std::string address;                            ///< of the client; set by the sockets
  SteadyTime given{};                             ///< when its head came; set by the API
  /// Of the client, verified; set by the sockets.
  std::optional<identity::ClientCertificate> certificate;
  storage::Actor who;                      ///< the caller, for authors and the audit trail
  std::optional<identity::Caller> caller;  ///< set by the API; absent: anybody

  std::string header(const std::string& lower_case_name) const;
  const std::string& parameter(const std::string& name) const { return parameters.at(name); }
};

/// What a database can hold.
inline constexpr std::uint64_t kMaxNumber = std::numeric_limits<std::int64_t>::max();

/// Reads the query parameters that a handler knows; any other is an error of finish().
class QueryReader {
 public:
  explicit QueryReader(const Request& request) : left_(request.target.query) {}
  std::optional<std::string> text(const std::string& name);
  /// Without a sign, at most `highest`.
  std::optional<std::uint64_t> number(const std::string& name, std::uint64_t highest);
  /// A finite decimal.
  std::optional<double> real(const std::string& name);
  /// As parse_iso8601 reads it.
  std::optional<UtcTime> time(const std::string& name);
  /// yes or no; without it no.
  bool flag(const std::string& name);
  /// What was not asked for, taken out.
  std::map<std::string, std::string> rest() { return std::exchange(left_, {}); }
  /// Errors: Syntax (no number, no decimal, no time, neither yes nor no, unknown parameter),
  /// LimitExceeded; the first error.
  Result<void> finish();

 private:
  void note(Error error);

  std::map<std::string, std::string> left_;
  std::optional<Error> error_;
};

/// All of `text` as a number without sign. Errors: Syntax.
Result<std::uint64_t> parse_unsigned(std::string_view text);

struct ByteRange {
  std::uint64_t first = 0;
  std::uint64_t length = 0;
};

/// One range of `size` bytes from a Range header: `bytes=a-b`, `bytes=a-`, `bytes=-n`. nullopt when
/// there is no header. Errors: LimitExceeded (it is after the end), Syntax, Unsupported (several
/// ranges).
Result<std::optional<ByteRange>> parse_byte_range(std::string_view header, std::uint64_t size);

}  // namespace dripline::api
