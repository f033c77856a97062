#pragma once

/// The commands with which a control drives its reader, or the host in its place: modem lines, or
/// characters where a line has none; its direction of the line carries nothing else.
///
///     run        RTS on (our CTS), or DC1
///     stop       RTS off, or DC3
///     backwards  DTR off while it runs (our DSR), or BS: to the rewind stop
namespace dripline::wire {

inline constexpr char kReaderRun = 0x11;
inline constexpr char kReaderStop = 0x13;
inline constexpr char kReaderBack = 0x08;

}  // namespace dripline::wire
