#pragma once

#include <string>
#include <string_view>

#include "clients/lib/api_types.hpp"

namespace dripline::cli {

/// "N10 G01<CR><LF>": control characters by their names, bytes over 0x7F as `<B1>`.
std::string named_characters(std::string_view bytes);

/// Turns what passed over a line into lines for people: time, direction, and the characters as text
/// or in hexadecimal. Characters of one direction are put together up to the end of a block, a
/// handshake (DC3, ACK ...), a pause of half a second, or the width of a line; the other direction
/// continues meanwhile. The time is that of a line's first character. Pure.
class TrafficText {
 public:
  struct Look {
    bool is_hex = false;
    bool has_color = false;
  };
  explicit TrafficText(Look look) : look_(look) {}

  /// The lines that are complete now, each with its line end. Errors in what the server sent
  /// (digits that are none) are shown as they are.
  std::string add(const client::Traffic& traffic);
  /// The characters that still wait for more of their kind.
  std::string flush();

 private:
  /// A line of one direction that may grow.
  struct Begun {
    std::string_view what;
    std::string first_time, last_time, bytes;
  };
  bool is_full(const Begun& begun, char next) const;
  std::string end(Begun& begun) const;
  std::string append(Begun& begun, std::string_view bytes, const client::Traffic& traffic) const;
  std::string line(std::string_view time, std::string_view what, std::string_view text) const;

  const Look look_;
  Begun sent_{"sent", {}, {}, {}}, received_{"received", {}, {}, {}};
};

}  // namespace dripline::cli
