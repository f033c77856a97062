#include "clients/tools/conversational/impl/posting.hpp"

namespace dripline::conversational {
namespace {

BlockText start_of(const Entry& x, const Entry& z) {
  return BlockText("G0").word("X", x).word("Z", z);
}

/// The distance of the nose from the root of a sharp thread, into P124, as the manual prints it:
/// non-movement blocks move it, as a tool of type 0, around a vertex at the origin.
void post_printed_truncation(Posting& out) {
  out.parameter(92, "P262");
  out.parameter(262, 0.0);
  out.block("G65 G42 G0 XC0 ZC0 R2 AB[90-P108/2]");
  out.block("G65 X0 Z0");
  out.block("G65 G40 R2 AB[90+P108/2]");
  out.parameter(124, "P209*2 - P261");
  out.parameter(262, "P92");
}

/// The remaining height, and the diameter to cut to.
void post_crest(Posting& out, const MultipleThread& event) {
  out.parameter(91, event.crest_x);
  out.parameter(101, event.lead);
  out.parameter(108, event.nose_angle);
  if (out.options().has_printed_crest_formula) {
    post_printed_truncation(out);
  } else {
    out.parameter(124, "P261/SIN[P108/2] - P261");
  }
  out.parameter(106, "P101/[2*TAN[P108/2]] - P124");
  out.parameter(124, "P91-2*P106");
  out.block("IF P139 < P91 THEN P124 = P91+2*P106");
}

}  // namespace

void post(Posting& out, const MultipleThread& event) {
  const bool is_crest = event.entry == ThreadEntry::Crest;
  out.parameter(103, event.chamfer_length);
  out.parameter(104, event.chamfer_angle);
  out.parameter(130, event.minimum_cut);
  if (event.finish_passes) out.parameter(131, *event.finish_passes);
  out.block(start_of(event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  if (is_crest) post_crest(out, event);
  BlockText block("G76");
  is_crest ? block.code("X[P124]") : block.word("X", event.root_x);
  block.word("Z", event.z).word("I", event.taper).word("Q", event.start_angle);
  block.word("F", event.lead);
  is_crest ? block.code("K[P106]") : block.word("K", event.height);
  block.word("A", event.nose_angle).word("D", event.first_cut);
  if (event.method) block.word("P", *event.method);
  out.block(block);
}

void post(Posting& out, const SingleThread& event) {
  out.block(start_of(event.start_x, event.start_z));
  out.clearances(event.start_x, event.start_z);
  out.parameter(103, event.chamfer_length);
  out.parameter(104, event.chamfer_angle);
  BlockText block("G40 G92");
  block.word("I", event.taper).word("X", event.x).word("U", event.u);
  block.word("Z", event.z).word("W", event.w).word("Q", event.start_angle);
  out.block(block.word("F", event.lead));
}

}  // namespace dripline::conversational
