#include <fmt/format.h>

#include "clients/tools/conversational/impl/posting.hpp"

namespace dripline::conversational {
namespace {

std::string_view code_of(ReturnPoint point) {
  return point == ReturnPoint::Clearance ? "G39" : "G38";
}

std::string_view code_of(Drilling kind) {
  switch (kind) {
    case Drilling::Drill:
      return "G81";
    case Drilling::DrillDwell:
      return "G82";
    case Drilling::DrillPeck:
      return "G83";
    case Drilling::Bore:
      return "G85";
    case Drilling::BoreDwell:
      return "G89";
  }
  return "";
}

}  // namespace

void post(Posting& out, const DrillCycle& event) {
  BlockText block(code_of(event.kind));
  block.word("P", event.dwell);
  block.word("Q", event.increment).word("E", event.peck_clearance).word("V", event.first_depth);
  block.word("R", event.clearance).word("Z", event.z).word("F", event.feed);
  out.block(block.code(code_of(event.return_point)));
}

void post(Posting& out, const TapCycle& event) {
  BlockText spindle("G97 G99");
  out.block(spindle.code(event.hand == Hand::Right ? "M3" : "M4").word("S", event.speed));
  BlockText block("G84");
  block.code(fmt::format("F[1/{}]", number_text(event.threads_per_unit.value_or(1))));
  block.word("R", event.clearance).word("Z", event.z);
  out.block(block.code(code_of(event.return_point)));
}

void post(Posting& out, const GrooveCycle& event) {
  const bool is_face = event.work == Work::Facing;
  BlockText block(is_face ? "G74" : "G75");
  block.word("Q", event.increment).word("U", event.peck_up).word("E", event.peck_clearance);
  block.word("V", event.first_depth).word("X", event.x);
  block.word(is_face ? "I" : "K", event.step).word("D", event.relief);
  block.word("A", event.x_finish_stock).word("C", event.z_finish_stock);
  block.word("R", event.clearance).word("Z", event.z).word("F", event.feed);
  out.block(block.code(code_of(event.return_point)));
}

}  // namespace dripline::conversational
