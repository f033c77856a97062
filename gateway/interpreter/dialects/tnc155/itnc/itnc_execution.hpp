#pragma once

#include "gateway/interpreter/dialects/tnc155/run.hpp"

/// What blocks of the later controls do where that differs from a TNC 155. Functions return false
/// when the run cannot continue (`Run::pause`).
namespace dripline::interpreter::tnc155::itnc {

/// Positioning with several M functions and F AUTO; `move` makes the motion.
bool position(Run& run, const Block& block, bool (*move)(Run&, const Block&));
/// CC, which may name the tool axis: circles then lie in a plane across the working plane.
bool set_pole(Run& run, const Block& block);
bool move_in_pole_plane(Run& run, const Block& block, bool (*move)(Run&, const Block&));
bool stop_block(Run& run, const Block& block);
bool cycle_call(Run& run, const Block& block);
bool cycle_call_at(Run& run, const Block& block);
/// APPR and DEP on a straight line, tangential or normal to the contour.
bool approach(Run& run, const Block& block);
bool depart(Run& run, const Block& block);
/// RND and CHF with a feed of their own.
bool corner(Run& run, const Block& block);
/// Degrees per minute that the F of `feed`, millimeters per minute, is for a rotary axis alone.
double rotary_feed_of(const Run& run, double feed);
/// TOOL CALL with DL, DR and F.
bool call_tool(Run& run, const Block& block);
bool use_preset(Run& run, int number);
bool accept(Run& run, const Block& block);

/// Q120 to Q122 before a PLANE has computed them. False.
bool fail_plane_angle(Run& run, std::int32_t parameter);
/// The same, where they are coordinates.
bool check_plane_angles(Run& run, const Block& block);
/// A QR parameter that neither the program nor the setup has set is an alarm.
bool check_retained(Run& run, std::int32_t parameter);
bool evaluate(Run& run, const Formula& formula, double& result);
bool assign(Run& run, const Block& block);
bool compare(Run& run, const Block& block);
bool raise_error(Run& run, const Block& block);
bool read_system(Run& run, const Block& block);
/// FN 16: the mask's text with the values now.
bool print(Run& run, const Block& block);

/// After a slot whose end is not stated: both axes of the plane, absolute, come first.
bool check_place_is_known(Run& run);
bool leave_open_place(Run& run, const Block& block);
inline constexpr int kFirstTable = 200;  ///< cycles from this number on are tables of Q words
bool define_table(Run& run, const Block& block);
/// A call of the cycle that was defined last, with a number from 200 on.
bool run_table(Run& run);
/// Where the cycle begins, program coordinates of the tool axis.
double clearance_height(Run& run);
/// Transformations whose order matters, and whose order the control's manual does not state.
bool check_order(Run& run, const Block& block);

}  // namespace dripline::interpreter::tnc155::itnc
