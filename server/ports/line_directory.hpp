#pragma once

#include <memory>
#include <string>
#include <vector>

#include "server/ports/line_records.hpp"
#include "server/ports/port_line.hpp"

namespace dripline::ports {

/// The line that each machine is connected to now. Any thread.
class LineDirectory {
 public:
  virtual ~LineDirectory() = default;
  /// nullptr: no enabled port has this machine.
  virtual std::shared_ptr<PortLine> line_of(const std::string& machine) const = 0;
  /// In order of the ports' names.
  virtual std::vector<std::shared_ptr<PortLine>> lines() const = 0;
  /// Of a machine that has, or had, a line. Used on its strand only.
  virtual std::shared_ptr<LineRecords> records_of(const std::string& machine) const = 0;
};

}  // namespace dripline::ports
