#pragma once

#include <string>

#include "storage/postgresql/link.hpp"

namespace dripline::storage::postgresql {

/// All rows come with the first step.
/// Rows that are posted with one INSERT after the other are sent as one of many rows: three times
/// as many a second.
class LinkCursor final : public sql::Cursor, private Link::Hoarder {
 public:
  /// The link must outlive it.
  LinkCursor(Link& link, std::string sql) : link_(link), sql_(std::move(sql)) {}
  LinkCursor(const LinkCursor&) = delete;
  LinkCursor& operator=(const LinkCursor&) = delete;
  ~LinkCursor() override;

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
  static constexpr int kTogether = 64;  ///< rows; each number of them is a statement of its own
  void send_rows() override;

  Link& link_;
  const std::string sql_;
  Parameters parameters_;
  std::vector<Parameters> rows_;  ///< kept back, all of the same kinds
  std::string kinds_;             ///< of these
  std::string many_;              ///< the SQL for kTogether rows; empty: not made, or there is none
  ResultPointer result_;          ///< null: not begun, or done
  int row_ = 0;
};

}  // namespace dripline::storage::postgresql
