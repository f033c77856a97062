#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace dripline::test_support {

/// Receives consecutive pieces of a generated program.
using TextSink = std::function<void(std::string_view)>;

/// What a roughing and finishing job on a Centurion lathe looks like when a CAM system writes every
/// pass out: G20, diameter X, passes of short straight blocks along a wavy profile, ending in M30.
/// Deterministic; exactly `blocks` lines. Units: inches. X stays within 0.5 .. 3.2 diameter, Z
/// within -6 .. 0.5.
void write_contour(std::uint64_t blocks, const TextSink& sink);

/// The same, at least `bytes` long and at most one block longer.
void write_contour_of_size(std::uint64_t bytes, const TextSink& sink);

/// A program that makes `lines` DPRNT lines with a short move before each, numbered from 1: `LINE
/// 1`, `LINE 2`, ... `moves_per_line` short moves come between two outputs.
void write_report_program(std::uint64_t lines, std::uint64_t moves_per_line, const TextSink& sink);

}  // namespace dripline::test_support
