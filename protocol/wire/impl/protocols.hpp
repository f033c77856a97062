#pragma once

#include <memory>

#include "protocol/wire/discipline.hpp"

/// One factory for each protocol; make_discipline() has checked the settings before it calls one.
namespace dripline::wire {

std::unique_ptr<Discipline> make_plain(const LineSettings& settings, Role role);
std::unique_ptr<Discipline> make_xmodem(const LineSettings& settings, Role role);
std::unique_ptr<Discipline> make_tnc_blockwise_host(const LineSettings& settings);
std::unique_ptr<Discipline> make_tnc_blockwise_control(const LineSettings& settings);
std::unique_ptr<Discipline> make_tnc_standard(const LineSettings& settings, Role role);
std::unique_ptr<Discipline> make_tape_reader_host(const LineSettings& settings);
std::unique_ptr<Discipline> make_tape_reader_control(const LineSettings& settings);

}  // namespace dripline::wire
