#include "storage/postgresql/cursor.hpp"

#include <libpq-fe.h>
#include <utility>

#include "storage/postgresql/sql_text.hpp"

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

LinkCursor::~LinkCursor() {
  if (link_.hoarder() == this) {
    link_.set_hoarder(nullptr);
    send_rows();
  }
}

Result<void> LinkCursor::post() {
  result_.reset();
  const std::string kinds = parameters_.kinds();
  if (kinds != kinds_) {
    if (link_.hoarder() == this) link_.set_hoarder(nullptr);
    send_rows();
    kinds_ = kinds;
    many_ = for_many_rows(sql_, parameters_.count(), kTogether);
  }
  if (many_.empty() || parameters_.has_blobs()) {
    link_.send(sql_, parameters_);
    return link_.leave_some();
  }
  if (link_.hoarder() != this) link_.set_hoarder(this);
  rows_.push_back(parameters_);
  if (rows_.size() < kTogether) return {};
  link_.set_hoarder(nullptr);
  send_rows();
  return link_.leave_some();
}

void LinkCursor::send_rows() {
  if (rows_.size() == kTogether) {
    Parameters all;
    for (Parameters& row : rows_) all.append(std::move(row));
    rows_.clear();
    link_.send(many_, all);
    return;
  }
  for (const Parameters& row : std::exchange(rows_, {})) link_.send(sql_, row);
}

}  // namespace dripline::storage::postgresql
