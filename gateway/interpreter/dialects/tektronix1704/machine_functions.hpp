#pragma once

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

/// Spindle, coolant, tool, quill and program control.
namespace dripline::interpreter::tektronix1704 {

/// S and T words.
void load_codes(Run& run);
/// The M word if it acts before the motion. False: alarm.
bool do_m_before(Run& run);
/// The M word if it acts when everything else is done. False: alarm; M02 and M30 end the run.
bool do_m_after(Run& run);
/// The full stroke of a quill drill cycle.
void stroke_quill(Run& run);
/// Ends the run after so many blocks: initial modes, spindle and coolant off.
void end_run(Run& run, std::uint64_t blocks, bool rewind);

}  // namespace dripline::interpreter::tektronix1704
