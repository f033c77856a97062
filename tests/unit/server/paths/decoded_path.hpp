#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace dripline::paths_test {

struct DecodedPoint {
  int move = 0;
  std::int64_t line = 1, offset = 0;
  std::array<std::int64_t, 3> at{};  ///< micrometers

  friend bool operator==(const DecodedPoint&, const DecodedPoint&) = default;
};

/// Reads points as the format's description has them, apart from the code that writes them.
class PointReader {
 public:
  std::vector<DecodedPoint> read(std::string_view bytes) {
    std::vector<DecodedPoint> points;
    while (!bytes.empty()) {
      const std::uint64_t head = number(bytes);
      last_.move = static_cast<int>(head & 7);
      last_.line += signed_of(head >> 3);
      last_.offset += signed_of(number(bytes));
      for (auto& value : last_.at) value += signed_of(number(bytes));
      points.push_back(last_);
    }
    return points;
  }

 private:
  static std::uint64_t number(std::string_view& bytes) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; !bytes.empty(); shift += 7) {
      const auto byte = static_cast<unsigned char>(bytes.front());
      bytes.remove_prefix(1);
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) break;
    }
    return value;
  }
  static std::int64_t signed_of(std::uint64_t value) {
    const auto half = static_cast<std::int64_t>(value >> 1);
    return (value & 1) != 0 ? -half - 1 : half;
  }

  DecodedPoint last_;
};

/// All of a path: its points and its JSON frames.
struct DecodedPath {
  std::vector<DecodedPoint> points;
  std::vector<nlohmann::json> notes;

  void add(std::string_view piece) {
    while (piece.size() >= 5) {
      std::size_t size = 0;
      for (std::size_t i = 4; i > 0; --i) size = size << 8 | static_cast<unsigned char>(piece[i]);
      const auto content = piece.substr(5, size);
      if (piece.front() == 'J') notes.push_back(nlohmann::json::parse(content));
      if (piece.front() == 'P') {
        const auto more = reader.read(content);
        points.insert(points.end(), more.begin(), more.end());
      }
      piece.remove_prefix(5 + content.size());
    }
  }

  PointReader reader;
};

}  // namespace dripline::paths_test
