#include "protocol/measurement/cut_line.hpp"

#include <algorithm>

namespace dripline::measurement {
namespace {

constexpr std::size_t kMaxText = 4096;  ///< of a record: protocol/dds/message.hpp

}  // namespace

std::string cut_line(std::string line) {
  line.resize(std::min(line.size(), kMaxText - kCutLine.size()));
  return line += kCutLine;
}

/// Room is left for the other end.
std::string rest_line(std::string line) {
  line.resize(std::min(line.size(), kMaxText - kCutLine.size() - kRestLine.size()));
  return line += kRestLine;
}

}  // namespace dripline::measurement
