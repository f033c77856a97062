// The text of a job that is sent to the line: what is near at once, the rest by the owner's tasks.
#include <algorithm>
#include <utility>

#include "gateway/line/port_line.hpp"

namespace dripline::line {
namespace {

constexpr std::uint64_t kFetchPiece = 32 * 1024;

/// How much of a job is asked for at once.
std::uint64_t piece_of(const SendJob& job) {
  if (job.prefetch == 0) return kFetchPiece;
  return std::clamp<std::uint64_t>(job.prefetch / 2, 1, kFetchPiece);
}

}  // namespace

void PortLine::fetch(const SendJob& job, std::uint64_t offset) {
  Wanted wanted{.id = job.id,
                .source = job.source,
                .offset = offset,
                .size = job.size,
                .piece = piece_of(job)};
  if (!parts_.post_near) return post_read(std::move(wanted));
  parts_.post_near([weak = weak_from_this(), wanted = std::move(wanted)] {
    const auto self = weak.lock();
    if (!self) return;
    std::string piece = wanted.source->near(wanted.offset, wanted.piece);
    if (piece.empty()) return self->post_read(wanted);
    self->supply(wanted, std::move(piece));
  });
}

void PortLine::post_read(Wanted wanted) {
  parts_.post([weak = weak_from_this(), wanted = std::move(wanted)] {
    if (const auto self = weak.lock()) self->read_piece(wanted);
  });
}

void PortLine::read_piece(const Wanted& wanted) {
  auto piece = wanted.source->read(wanted.offset, wanted.piece);
  const bool has_come = !piece || !piece->empty() || wanted.offset >= wanted.size;
  if (!has_come) {
    wanted_ = wanted;
    return;
  }
  wanted_.reset();
  supply(wanted, std::move(piece));
}

void PortLine::supply(const Wanted& wanted, Result<std::string> piece) {
  // The driver is this object's own: no work outlives it.
  with_line([this, id = wanted.id, offset = wanted.offset, piece = std::move(piece)](
                wire::Discipline& line, wire::LineTime now) {
    if (!piece) return session_.supply_failed(id, piece.error(), line, now);
    session_.supply(id, offset, *piece, line, now);
    refresh();  // what waits here is no more with who gave it
  });
}

void PortLine::on_text() {
  if (const auto wanted = std::exchange(wanted_, std::nullopt)) read_piece(*wanted);
}

}  // namespace dripline::line
