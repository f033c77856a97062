#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

/// The serial data on the Centurion's CTRL parameter page, as a record: what a line must be set to
/// for a page, and the page for a line.
namespace dripline::wire {

enum class ComPort : std::uint8_t { None, Com1, Com2 };

/// One of the control's connectors.
struct ComFormat {
  unsigned baud = 9600;
  Parity parity = Parity::Even;
  unsigned data_bits = 7;
  StopBits stop_bits = StopBits::Two;
};

struct CenturionPage {
  ComPort primary = ComPort::Com1, secondary = ComPort::None;
  std::array<ComFormat, 2> com;  ///< COM1, COM2
  unsigned buffer_size = 256;    ///< characters the control still takes after its XOFF
  bool lf_becomes_cr = false;    ///< of what it receives: needed when the host ends blocks with LF
  bool sends_cr_lf = true;       ///< else CR alone ends a block it sends
  unsigned end_of_file = 0;      ///< ASCII value sent after a file; 0: none
  unsigned tape_start = 0, tape_stop = 0;  ///< set at the tape reader on the secondary port
};

/// One entry of the page: drives reading, errors and listings.
struct PageRow {
  std::string_view key;   ///< "com1_baud", "eof_character" ...
  std::string_view type;  ///< for people
  std::string_view text;  ///< what the page calls it
  /// Errors: Syntax, LimitExceeded, naming key, value and what is allowed.
  Result<void> (*set)(CenturionPage& page, std::string_view key, std::string_view value);
  std::string (*get)(const CenturionPage& page);  ///< as `set` reads it
};
std::span<const PageRow> page_rows();
/// Errors: NotFound (the key), and those of the row; `page` is then unchanged.
Result<void> set_page_value(CenturionPage& page, std::string_view key, std::string_view value);

/// The page's port a line is connected to. The secondary one can be the tape reader's.
enum class PagePort : std::uint8_t { Primary, Secondary };

/// The settings of a line to that port: both ends alike, text as the page has it.
/// Errors: Unsupported (the port is NONE, or both are the same connector).
Result<LineSettings> line_of_page(const CenturionPage& page, PagePort port);

/// The page for a line on that port. Errors: Unsupported, naming the setting the
/// page has no entry for, such as 57600 baud or another code than ASCII.
Result<CenturionPage> page_of_line(const LineSettings& line, PagePort port);

}  // namespace dripline::wire
