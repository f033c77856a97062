#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/api/request.hpp"
#include "server/api/response.hpp"
#include "server/machines/machine_control.hpp"
#include "server/mtconnect/agent_request.hpp"
#include "server/mtconnect/body_budget.hpp"
#include "server/mtconnect/cutting_tools.hpp"
#include "server/mtconnect/device_model.hpp"
#include "server/mtconnect/documents.hpp"
#include "server/mtconnect/observation_buffer.hpp"
#include "server/mtconnect/observer.hpp"
#include "server/mtconnect/path_selection.hpp"
#include "storage/setup_store.hpp"

namespace dripline::mtconnect {

/// The MTConnect agent without its sockets: what happens at the machines in, documents out. It only
/// answers GET and HEAD and changes nothing. Any thread.
class Agent {
 public:
  struct Options {
    std::string sender;          ///< the computer's name
    std::string plant;           ///< makes UUIDs unique: the identity of the database
    std::uint64_t instance = 0;  ///< another one at every start
    std::size_t buffer_size = ObservationBuffer::kCapacity;
    std::uint64_t body_memory = 128ull * 1024 * 1024;  ///< of large documents in progress
    std::function<std::vector<storage::Record>(const std::string& machine)> last_alarms = {};
  };
  Agent(Options options, const Clock& clock);

  /// What the machines do is observed with it.
  Observer& observer() { return observer_; }
  /// Replaces the tools of a machine by those of its newest setup. `is_first`: at the start, when
  /// no client has seen others. A setup that cannot be read is logged and leaves the tools.
  void use_setup(const storage::SetupRevision& setup, const std::string& control, bool is_first);

  /// The answer to a request that is not allowed, by its head alone; on the socket thread.
  std::optional<api::Response> judge(const api::Request& head) const;
  /// A document, or the multipart stream of `interval=`. Streams must end before the agent.
  api::Response handle(const api::Request& request);

 private:
  class PartStream;
  class CurrentStream;
  class SampleStream;
  using Items = std::shared_ptr<const ItemSet>;  ///< nullptr: all

  HeaderFacts header(const Model& model) const;
  api::Response refuse(const AgentError& error) const;
  api::Response document(std::string xml);
  Asked<std::string> answer(const AgentRequest& request);
  Asked<const Device*> device_of(const Model& model, const std::string& name) const;
  Asked<Items> items_of(const Model& model, const AgentRequest& request);
  Asked<std::string> current(const AgentRequest& request);
  /// A Streams document, what is to be asked for next, and how many observations it has.
  struct Part {
    std::string xml;
    std::uint64_t next = 1;
    std::size_t size = 0;
  };
  Asked<Part> sample(const AgentRequest& request);
  Asked<std::string> assets(const AgentRequest& request) const;
  /// The body of `/current` without parameters, kept until something is observed.
  struct Current {
    std::uint64_t next = 0, revision = 0;
    ObservationBuffer::Range range;
    std::string body;
  };
  std::shared_ptr<const Current> whole_current(const Model& model);
  api::Response stream(const AgentRequest& request);

  const Options options_;
  const Clock& clock_;
  DeviceModel model_;
  ObservationBuffer buffer_;
  Observer observer_;
  PathSelection paths_;
  Assets assets_;
  BodyBudget budget_;
  std::mutex current_mutex_;  ///< held while the body is made: others wait for the same one
  std::shared_ptr<const Current> current_;
};

/// A number that is greater than at any start before: microseconds since 1970.
std::uint64_t instance_of(UtcTime start);

}  // namespace dripline::mtconnect
