#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "server/api/request.hpp"

namespace dripline::mtconnect {

/// What an Error document says, and the status of its answer.
struct AgentError {
  int status = 400;
  std::string_view code = "INVALID_REQUEST";  ///< as the schema has it
  std::string text;
};
template <class T>
using Asked = tl::expected<T, AgentError>;

AgentError out_of_range(std::string text);

/// A request of MTConnect: `/probe`, `/current`, `/sample`, `/assets`, each also after a device.
struct AgentRequest {
  enum class Kind : std::uint8_t { Probe, Current, Sample, Assets };

  /// Parts of a stream carry at most this many observations; the rest follows in the next part.
  static constexpr std::int64_t kMaxPart = 10'000;
  static constexpr std::size_t kMaxPath = 1024;
  static constexpr std::size_t kMaxAssetIds = 256;

  Kind kind = Kind::Probe;
  std::string device;  ///< name or UUID; empty: all
  std::string path;    ///< XPath; empty: all
  std::optional<std::uint64_t> at, from;
  std::int64_t count = 100;  ///< not 0
  std::optional<std::chrono::milliseconds> interval;
  std::chrono::milliseconds heartbeat{10'000};
  std::vector<std::string> asset_ids;  ///< not empty: these assets alone
  std::string asset_type;              ///< empty: all
  bool with_removed = false;
};

/// Parameters that are not MTConnect's are ignored: clients add their own. Pure; any thread.
/// Errors: INVALID_REQUEST, INVALID_URI, OUT_OF_RANGE (by the standard's own limits;
/// `buffer_size`: a `count` may not be more).
Asked<AgentRequest> read_request(const api::Target& target, std::uint64_t buffer_size);

}  // namespace dripline::mtconnect
