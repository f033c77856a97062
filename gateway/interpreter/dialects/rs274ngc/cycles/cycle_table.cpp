#include "gateway/interpreter/dialects/rs274ngc/cycles/cycle_table.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

using enum Step;
constexpr std::array kNist{
    CycleRow{810, {FeedToBottom, RapidToClear}, false, false, false, false},
    CycleRow{820, {FeedToBottom, Dwell, RapidToClear}, true, false, false, false},
    CycleRow{830, {Peck, RapidToClear}, false, true, false, false},
    CycleRow{840,
             {FeedToBottom, SpindleStop, SpindleReverse, FeedToClear, SpindleStop, SpindleRestore},
             false,
             false,
             false,
             true},
    CycleRow{850, {FeedToBottom, FeedToClear}, false, false, false, false},
    CycleRow{860,
             {FeedToBottom, Dwell, SpindleStop, RapidToClear, SpindleRestore},
             true,
             false,
             false,
             true},
    CycleRow{870, {BackBore}, false, false, true, true},
    CycleRow{880,
             {FeedToBottom, Dwell, SpindleStop, OperatorStop, SpindleRestore},
             true,
             false,
             false,
             true},
    CycleRow{890, {FeedToBottom, Dwell, FeedToClear}, true, false, false, false},
};
/// Where the later program differs.
constexpr std::array kLater{
    CycleRow{730, {Chip, RapidToClear}, false, true, false, false},
    CycleRow{740,
             {FeedToBottom, SpindleReverse, Dwell, FeedToClear, SpindleRestore},
             false,
             false,
             false,
             true},
    CycleRow{840,
             {FeedToBottom, SpindleReverse, Dwell, FeedToClear, SpindleRestore},
             false,
             false,
             false,
             true},
    CycleRow{850, {FeedToBottom, FeedToR, RapidToClear}, false, false, false, false},
};

}  // namespace

const CycleRow& cycle_row(int code, bool is_later) {
  if (is_later) {
    for (const CycleRow& row : kLater) {
      if (row.code == code) return row;
    }
  }
  for (const CycleRow& row : kNist) {
    if (row.code == code) return row;
  }
  return kNist[0];
}

}  // namespace dripline::interpreter::rs274ngc
