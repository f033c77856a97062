#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::differential {

using MachinePoint =
    std::array<double, 3>;  ///< X, Y, Z of the machine, mm, the tool's length left out

/// The work systems and the tool that the programs run with.
inline constexpr std::string_view kFrameSetup =
    "[start]\nX = 0.0\nY = 0.0\nZ = 100.0\n[[offset]]\nname = \"G54\"\nX = 10.0\nY = -5.0\nZ = "
    "2.0\n"
    "[[offset]]\nname = \"G55\"\nX = -30.0\nY = 40.0\nZ = -1.0\n[[offset]]\nname = \"EXT\"\nX = "
    "1.0\n"
    "[[tool]]\nnumber = 1\nlength = 30.0\n[control]\noffset_memory = \"C\"\n";

/// A program of a Fanuc-class mill between G52, G54, G55, G92, G51, G51.1, G68, G90 and G91, and
/// where its moves end: computed here from the manual, with nothing of the interpreter.
struct FrameProgram {
  std::string text;
  std::vector<MachinePoint> ends;
};

/// The same number makes the same program.
FrameProgram make_frame_program(std::uint64_t number);

}  // namespace dripline::differential
