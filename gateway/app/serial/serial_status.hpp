#pragma once

#include "gateway/app/panel/consent.hpp"
#include "gateway/app/serial/line_calls.hpp"
#include "gateway/app/serial/serial_records.hpp"
#include "gateway/app/serial/serial_run.hpp"
#include "gateway/app/serial/upload_store.hpp"
#include "gateway/app/server_link.hpp"

namespace dripline::gateway {

/// What the status of a machine on the gateway's own line is made of.
struct SerialState {
  const GatewayOptions& options;
  std::uint64_t session = 0;
  const Clock& clock;
  const report::Outbox& outbox;
  const SerialRecords& records;
  const SerialRun& run;
  const Consent& consent;
  const ServerLink& server;
  const UploadStore& uploads;
  const LineCalls& calls;
  line::LineView view = {};
  std::optional<line::SendProgress> progress = {};
  std::uint64_t recorded = 0;  ///< FlightRecorder::next_number
  bool is_emergency_stopped = false;
  // Of one moment: the line continues while a status is made, and counting walks the buffer.
  std::uint64_t buffered_bytes = 0;
  double buffered_seconds = 0;
  bool has_all_text = false;

  bool is_starved() const { return buffered_bytes == 0 && !has_all_text; }
};

/// A line reports nothing of the machine itself: no position, no block that is executed.
dds::Status make_status(const SerialState& state);

}  // namespace dripline::gateway
