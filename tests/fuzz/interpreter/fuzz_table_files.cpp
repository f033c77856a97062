#include <cstdint>
#include <string_view>

#include "gateway/interpreter/dialects/rs274ngc/memory/table_files.hpp"
#include "protocol/base/invariant.hpp"

/// LinuxCNC's tool table, up to the first zero byte, and its parameter file. What is accepted is a
/// setup, and written again and read it is the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  using namespace dripline::interpreter;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const auto end = bytes.find('\0');
  const std::string_view tools = bytes.substr(0, end);
  const std::string_view parameters =
      end == bytes.npos ? std::string_view{} : bytes.substr(end + 1);
  (void)rs274ngc::is_tool_table(bytes);
  (void)rs274ngc::is_parameter_file(bytes);
  const auto toml = rs274ngc::setup_of_table_files(tools, parameters, Units::Inch);
  if (!toml) return 0;
  const auto setup = parse_control_data(*toml);
  invariant(setup.has_value(), "it is a setup");
  const auto table = rs274ngc::write_tool_table(*setup);
  const auto file = rs274ngc::write_parameter_file(*setup);
  invariant(table && file, "a setup of such files has them");
  const auto again = rs274ngc::setup_of_table_files(*table, *file, Units::Inch);
  invariant(again.has_value(), "what is written is read");
  return 0;
}
