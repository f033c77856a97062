#include "storage/lease_watch.hpp"

#include <algorithm>

namespace dripline::storage {
namespace {

/// Two steady clocks differ by less, also while one of them is being slewed.
constexpr int kMarginPart = 10;

}  // namespace

bool LeaseWatch::is_over(const Look& look) {
  if (row_ != look.row) {
    row_ = look.row;
    gap_ = lease_ / 2;
    period_ = std::max(lease_, std::min(look.left, kLongestLease));
    period_ += period_ / kMarginPart;
    since_.reset();
  } else if (since_ && look.answered - seen_ > gap_) {
    gap_ *= 2;
    since_.reset();
  }
  seen_ = look.answered;
  if (look.row.holder.empty()) return true;
  if (!since_) since_ = look.answered;
  return look.asked - *since_ >= period_;
}

}  // namespace dripline::storage
