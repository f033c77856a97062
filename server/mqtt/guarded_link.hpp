#pragma once

#include <functional>
#include <memory>

#include "server/mqtt/broker_link.hpp"

namespace dripline::mqtt {

/// A link that is open only while `may_publish`: of servers that share a library the one whose
/// place is not confirmed is cut off from the broker, whatever wakes up or reconnects, because
/// another one may publish by now. The broker publishes its will then. `may_publish` answers at
/// once, and is asked often, on the thread of the link.
std::unique_ptr<BrokerLink> make_guarded_link(std::unique_ptr<BrokerLink> link,
                                              std::function<bool()> may_publish);

}  // namespace dripline::mqtt
