#pragma once

#include "protocol/base/clock.hpp"
#include "server/library/releases.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// What runs are made from: the stored things, who decides which of them a machine gets, the time.
struct RunSources {
  const storage::Store& store;
  library::Releases& releases;
  const Clock& clock;
};

}  // namespace dripline::machines
