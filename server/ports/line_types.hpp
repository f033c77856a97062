#pragma once

#include "gateway/line/port_line.hpp"

/// What the ports use of the library that they share with gateways on a line.
namespace dripline::ports {

using line::Incoming;
using line::JobKind;
using line::LineOpener;
using line::LineSession;
using line::LineView;
using line::PortLine;
using line::PortListener;
using line::SendEnd;
using line::SendJob;
using line::SendOutcome;
using line::SendProgress;

}  // namespace dripline::ports
