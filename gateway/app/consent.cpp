#include "gateway/app/consent.hpp"

#include "protocol/dds/stop_orders.hpp"

namespace dripline::gateway {
namespace {

/// Switching these off lets a machine run on where it would have stood.
bool lets_run_on(const dds::Order& order, const machine::OperatorPanel& panel) {
  if (order.value != 0) return false;
  if (order.argument == "emergency_stop") return panel.emergency_stop;
  if (order.argument == "single_block") return panel.single_block;
  if (order.argument == "optional_stop") return panel.optional_stop;
  if (order.argument == "handwheel") return panel.handwheel;
  return false;
}

}  // namespace

bool needs_consent(const dds::Order& order, const machine::OperatorPanel& panel) {
  using dds::OrderAction;
  switch (order.action) {
    case OrderAction::Start:
    case OrderAction::Hold:
    case OrderAction::Abort:
    case OrderAction::Refuse:  // is no order
      return false;
    case OrderAction::Switch:
      return lets_run_on(order, panel);
    case OrderAction::FeedOverride:
    case OrderAction::RapidOverride:
    case OrderAction::SpindleOverride:
      return !(order.value <= dds::override_of(order.action, panel));
    case OrderAction::Resume:
    case OrderAction::Answer:
    case OrderAction::Handwheel:
      break;
  }
  return true;
}

}  // namespace dripline::gateway
