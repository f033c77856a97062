#include "server/mqtt/guarded_link.hpp"

#include <utility>

namespace dripline::mqtt {
namespace {

constexpr const char* kNotOurs =
    "this server does not reach the database, and another one may have taken over";

class GuardedLink final : public BrokerLink {
 public:
  GuardedLink(std::unique_ptr<BrokerLink> link, std::function<bool()> may_publish)
      : link_(std::move(link)), may_publish_(std::move(may_publish)) {}

  Result<void> open(const Message& will, const std::string& subscribed) override {
    if (!may_publish_()) return fail(Errc::Busy, "{}", kNotOurs);
    return link_->open(will, subscribed);
  }
  Result<std::uint64_t> publish(const Message& message) override {
    if (!may_publish_()) return fail(Errc::Busy, "{}", kNotOurs);
    return link_->publish(message);
  }
  Progress wait(std::chrono::milliseconds limit) override {
    if (!may_publish_()) return lose({});
    Progress progress = link_->wait(limit);
    // What the broker has acknowledged it has.
    return may_publish_() ? progress : lose(std::move(progress.acknowledged));
  }
  void wake() override { link_->wake(); }
  /// Without taking leave where the place is lost: subscribers are to know.
  void close() override { may_publish_() ? link_->close() : link_->drop(); }
  void drop() override { link_->drop(); }

 private:
  Progress lose(std::vector<Acknowledgment> acknowledged) {
    link_->drop();
    return {.is_lost = true, .fault = kNotOurs, .acknowledged = std::move(acknowledged)};
  }

  const std::unique_ptr<BrokerLink> link_;
  const std::function<bool()> may_publish_;
};

}  // namespace

std::unique_ptr<BrokerLink> make_guarded_link(std::unique_ptr<BrokerLink> link,
                                              std::function<bool()> may_publish) {
  return std::make_unique<GuardedLink>(std::move(link), std::move(may_publish));
}

}  // namespace dripline::mqtt
