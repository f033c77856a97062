#pragma once

#include <string>

#include "storage/postgresql/link.hpp"

namespace dripline::storage::postgresql {

/// All rows come with the first step.
class LinkCursor final : public sql::Cursor {
 public:
  /// The link must outlive it.
  LinkCursor(Link& link, std::string sql) : link_(link), sql_(std::move(sql)) {}

  Result<bool> step() override;
  Result<void> run() override;
  Result<void> post() override;
  void reset() override { result_.reset(); }

  void bind_integer(int position, std::int64_t value) override {
    parameters_.set_integer(position, value);
  }
  void bind_real(int position, double value) override { parameters_.set_real(position, value); }
  void bind_text(int position, const std::string& value) override {
    parameters_.set_text(position, value);
  }
  void bind_blob(int position, std::span<const std::byte> value) override {
    parameters_.set_blob(position, value);
  }
  void bind_null(int position, sql::Kind kind) override { parameters_.set_null(position, kind); }

  std::int64_t integer(int column) const override {
    return integer_at(result_.get(), row_, column);
  }
  double real(int column) const override { return real_at(result_.get(), row_, column); }
  std::string text(int column) const override { return text_at(result_.get(), row_, column); }
  std::span<const std::byte> blob(int column) const override {
    return bytes_at(result_.get(), row_, column);
  }
  bool is_null(int column) const override {
    return postgresql::is_null(result_.get(), row_, column);
  }

 private:
  Link& link_;
  const std::string sql_;
  Parameters parameters_;
  ResultPointer result_;  ///< null: not begun, or done
  int row_ = 0;
};

}  // namespace dripline::storage::postgresql
