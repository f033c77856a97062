#include "storage/postgresql/cursor.hpp"

#include <libpq-fe.h>

namespace dripline::storage::postgresql {

Result<bool> LinkCursor::step() {
  if (result_ == nullptr) {
    link_.send(sql_, parameters_);
    auto answered = link_.answer();
    if (!answered) return fail(answered.error());
    result_ = *std::move(answered);
    row_ = -1;
  }
  if (++row_ < PQntuples(result_.get())) return true;
  result_.reset();
  return false;
}

Result<void> LinkCursor::run() {
  result_.reset();
  link_.send(sql_, parameters_);
  if (auto answered = link_.answer(); !answered) return fail(answered.error());
  return {};
}

Result<void> LinkCursor::post() {
  result_.reset();
  link_.send(sql_, parameters_);
  return link_.leave_some();
}

}  // namespace dripline::storage::postgresql
