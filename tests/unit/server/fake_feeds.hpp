#pragma once

#include <vector>

#include "server/feeds/feed_control.hpp"

namespace dripline::server_test {

/// Machines that exist because a test says so, and orders that are only noted.
class FakeFeeds final : public feeds::FeedControl {
 public:
  std::vector<feeds::MachineView> machines() const override { return views; }
  Result<feeds::MachineView> machine(const std::string& name) const override {
    for (const auto& view : views) {
      if (view.machine.name == name) return view;
    }
    return fail(Errc::NotFound, "machine '{}' is not known", name);
  }
  Result<storage::Run> start(const feeds::StartRequest& request) override {
    started.push_back(request);
    if (refusal) return fail(*refusal);
    if (auto view = machine(request.machine); !view) return fail(view.error());
    return run;
  }
  Result<void> order(const feeds::OrderRequest& request) override {
    ordered.push_back(request);
    if (refusal) return fail(*refusal);
    return {};
  }

  std::vector<feeds::MachineView> views;
  std::vector<feeds::StartRequest> started;
  std::vector<feeds::OrderRequest> ordered;
  std::optional<Error> refusal;
  storage::Run run;
};

}  // namespace dripline::server_test
