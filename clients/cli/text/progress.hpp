#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

#include "clients/cli/text/terminal.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::cli {

/// One moment of some long work on bytes.
struct ProgressView {
  std::string label;
  std::uint64_t done = 0, total = 0;  ///< bytes
  double seconds = 0;                 ///< since it began
};

/// "label [#####.....]  50 %  5.0 of 10.0 MB  2.5 MB/s  0:02 left", at most `width` columns.
std::string render_progress(const ProgressView& view, std::size_t width);
/// "[#####.....]" for 0 <= fraction <= 1.
std::string render_bar(double fraction, std::size_t cells);

/// Shows long work on a terminal, redrawn at most ten times a second; nothing in a pipe. The clock
/// and the area must outlive it. The bar vanishes with it; the result is then printed in words.
class Progress {
 public:
  Progress(LiveArea& area, const Clock& clock, std::string label);
  ~Progress() { area_.clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(std::uint64_t done, std::uint64_t total);

 private:
  LiveArea& area_;
  const Clock& clock_;
  std::string label_;
  SteadyTime begun_;
  std::optional<SteadyTime> drawn_;
};

}  // namespace dripline::cli
