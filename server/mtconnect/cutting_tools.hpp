#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::mtconnect {

/// A tool of a machine as an asset of MTConnect (CuttingTool). `content` is the XML within it.
struct CuttingTool {
  std::string id;    ///< lathe-1.T3
  std::string tool;  ///< T3
  std::string content;
};

/// The tools of a machine's setup, in the order of their numbers. Lengths and radii include the
/// wear. Pure. Errors: those of the setup's text; Unsupported (control).
Result<std::vector<CuttingTool>> read_tools(const std::string& machine, std::string_view control,
                                            std::string_view toml);

/// The assets of all machines. One that is no longer in its machine's setup stays, as removed,
/// until the server ends. Any thread.
class Assets {
 public:
  static constexpr std::size_t kMaxAssets = 131'072;  ///< more are left out

  struct Changes {
    std::vector<std::string> changed, removed;  ///< ids
  };
  struct Setup {
    std::string machine, device_uuid;
    std::uint64_t number = 0;  ///< one that is not greater than the last of its machine is ignored
    std::vector<CuttingTool> tools;
    UtcTime time;  ///< when this setup was made
  };
  Changes replace(const Setup& setup);

  struct Filter {
    std::string device_uuid;  ///< empty: all
    bool with_removed = false;
    std::size_t count = 100;
  };
  /// Whole elements, the last changed first.
  std::vector<std::string> list(const Filter& filter) const;
  /// The whole element, also when it is removed; nullopt: there is none.
  std::optional<std::string> find(const std::string& id) const;
  std::size_t size() const;  ///< without removed ones

 private:
  struct Asset {
    CuttingTool tool;
    std::string device_uuid;
    UtcTime time;
    std::uint64_t order = 0;  ///< of its last change
    bool is_removed = false;
  };
  static std::string element(const Asset& asset);

  mutable std::mutex mutex_;
  std::map<std::string, Asset, std::less<>> assets_;  ///< by id
  std::map<std::uint64_t, std::string> by_order_;     ///< ids
  std::map<std::string, std::uint64_t> numbers_;      ///< of the machines' setups
  std::uint64_t changes_ = 0;
  std::size_t removed_ = 0;
};

}  // namespace dripline::mtconnect
