#include "server/mtconnect/agent.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::mtconnect {
namespace {

constexpr const char* kXml = "text/xml";
constexpr int kTryAgain = 503;
/// Streams ask no more often whether something was observed.
constexpr std::chrono::milliseconds kShortest{10};

tl::unexpected<AgentError> forward(const AgentError& error) {
  return tl::unexpected<AgentError>(error);
}

/// A part of a multipart body. The length is that of the document alone.
std::string part_text(std::string_view boundary, std::string_view xml) {
  std::string text = fmt::format("\r\n--{}\r\nContent-type: text/xml\r\nContent-length: {}\r\n\r\n",
                                 boundary, xml.size());
  text += xml;
  return text;
}

}  // namespace

std::uint64_t instance_of(UtcTime start) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(start.time_since_epoch().count(), 1));
}

Agent::Agent(Options options, const Clock& clock)
    : options_(std::move(options)),
      clock_(clock),
      model_(options_.plant, clock.now()),
      buffer_(options_.buffer_size),
      observer_({.model = model_,
                 .buffer = buffer_,
                 .clock = clock,
                 .last_alarms = options_.last_alarms}),
      budget_(options_.body_memory) {}

void Agent::use_setup(const storage::SetupRevision& setup, const std::string& control,
                      bool is_first) {
  auto tools = read_tools(setup.machine, control, setup.text);
  if (!tools) {
    process::log_warning("mtconnect: tools of setup {} not read machine={}: {}", setup.number,
                         setup.machine, tools.error().what);
    return;
  }
  const auto changes = assets_.replace({.machine = setup.machine,
                                        .device_uuid = model_.uuid_of(setup.machine),
                                        .number = setup.number,
                                        .tools = *std::move(tools),
                                        .time = setup.created});
  if (is_first) return;
  for (const auto& id : changes.removed) observer_.observe_asset(setup.machine, id, true);
  for (const auto& id : changes.changed) observer_.observe_asset(setup.machine, id, false);
}

HeaderFacts Agent::header(const Model& model) const {
  return {.sender = options_.sender,
          .instance = options_.instance,
          .buffer_size = buffer_.capacity(),
          .created = clock_.now(),
          .model_changed = model.changed,
          .assets = assets_.size(),
          .asset_buffer_size = Assets::kMaxAssets};
}

api::Response Agent::refuse(const AgentError& error) const {
  api::Response response;
  response.status = error.status;
  response.content_type = kXml;
  response.body = error_document(header(*model_.snapshot()), error.code, error.text);
  if (error.status == kTryAgain) response.headers.emplace_back("Retry-After", "1");
  return response;
}

std::optional<api::Response> Agent::judge(const api::Request& head) const {
  if (head.method == "GET" || head.method == "HEAD") return std::nullopt;
  auto response =
      refuse({405, "UNSUPPORTED", fmt::format("{}: this agent only reads", head.method)});
  response.headers.emplace_back("Allow", "GET, HEAD");
  return response;
}

/// A large document is sent from a share of the memory for such, which it returns at its end.
api::Response Agent::document(std::string xml) {
  api::Response response;
  response.content_type = kXml;
  response.headers.emplace_back("Cache-Control", "no-cache");
  auto share = budget_.take(xml.size());
  if (!share)
    return refuse(
        {kTryAgain, "INTERNAL_ERROR", "too many large documents are being sent; ask again"});
  if (xml.size() < BodyBudget::kSmall) {
    response.body = std::move(xml);
    return response;
  }
  response.source_length = xml.size();
  response.source = [text = std::make_shared<std::optional<std::string>>(std::move(xml)),
                     held = std::make_shared<BodyBudget::Share>(*std::move(share))]()
      -> Result<std::optional<std::string>> { return std::exchange(*text, std::nullopt); };
  return response;
}

api::Response Agent::handle(const api::Request& request) {
  if (auto refused = judge(request)) return *std::move(refused);
  const auto asked = read_request(request.target, buffer_.capacity());
  if (!asked) return refuse(asked.error());
  if (asked->interval) return stream(*asked);
  auto xml = answer(*asked);
  return xml ? document(*std::move(xml)) : refuse(xml.error());
}

Asked<std::string> Agent::answer(const AgentRequest& request) {
  switch (request.kind) {
    case AgentRequest::Kind::Probe: {
      const auto model = model_.snapshot();
      const auto device = device_of(*model, request.device);
      if (!device) return forward(device.error());
      return devices_document(header(*model), *model, *device);
    }
    case AgentRequest::Kind::Current:
      return current(request);
    case AgentRequest::Kind::Sample: {
      auto part = sample(request);
      if (!part) return forward(part.error());
      return std::move(part->xml);
    }
    case AgentRequest::Kind::Assets:
      return assets(request);
  }
  return forward({500, "INTERNAL_ERROR", "an unknown kind of request"});
}

Asked<const Device*> Agent::device_of(const Model& model, const std::string& name) const {
  if (name.empty()) return nullptr;
  if (const Device* device = model.find(name)) return device;
  return forward({404, "NO_DEVICE", fmt::format("there is no device '{}'", name)});
}

Asked<Agent::Items> Agent::items_of(const Model& model, const AgentRequest& request) {
  const auto device = device_of(model, request.device);
  if (!device) return forward(device.error());
  if (!request.path.empty()) return paths_.select(model, *device, request.path);
  if (*device == nullptr) return nullptr;
  auto items = std::make_shared<ItemSet>();
  for (const std::uint32_t item : (*device)->items) {
    if (item != Device::kNone) items->add(item);
  }
  return items;
}

std::shared_ptr<const Agent::Current> Agent::whole_current(const Model& model) {
  const std::lock_guard lock(current_mutex_);
  if (current_ && current_->next == buffer_.next() && current_->revision == model.revision)
    return current_;
  const auto state = buffer_.latest();
  current_ =
      std::make_shared<Current>(Current{state.range.next, model.revision, state.range,
                                        current_body(*model_.snapshot(), state.latest, nullptr)});
  return current_;
}

Asked<std::string> Agent::current(const AgentRequest& request) {
  const auto model = model_.snapshot();
  const auto items = items_of(*model, request);
  if (!items) return forward(items.error());
  if (!request.at && *items == nullptr) {
    const auto whole = whole_current(*model);
    return streams_document(header(*model), whole->range, whole->next, whole->body);
  }
  auto state =
      request.at ? buffer_.at(*request.at) : Result<ObservationBuffer::State>(buffer_.latest());
  if (!state) return forward(out_of_range(state.error().what));
  return streams_document(header(*model), state->range, state->range.next,
                          current_body(*model, state->latest, items->get()));
}

Asked<Agent::Part> Agent::sample(const AgentRequest& request) {
  const auto items = items_of(*model_.snapshot(), request);
  if (!items) return forward(items.error());
  auto answer =
      buffer_.sample({.from = request.from, .count = request.count, .items = items->get()});
  if (!answer) return forward(out_of_range(answer.error().what));
  const auto model = model_.snapshot();  // has every item that was observed
  return Part{streams_document(header(*model), answer->range, answer->next,
                               sample_body(*model, answer->observations)),
              answer->next, answer->observations.size()};
}

Asked<std::string> Agent::assets(const AgentRequest& request) const {
  const auto model = model_.snapshot();
  std::vector<std::string> elements;
  for (const auto& id : request.asset_ids) {
    auto element = assets_.find(id);
    if (!element)
      return forward({404, "ASSET_NOT_FOUND", fmt::format("there is no asset '{}'", id)});
    elements.push_back(*std::move(element));
  }
  if (request.asset_ids.empty()) {
    const auto device = device_of(*model, request.device);
    if (!device) return forward(device.error());
    const bool is_ours = request.asset_type.empty() || request.asset_type == "CuttingTool";
    if (is_ours) {
      elements = assets_.list({.device_uuid = *device == nullptr ? "" : (*device)->uuid,
                               .with_removed = request.with_removed,
                               .count = static_cast<std::size_t>(request.count)});
    }
  }
  return assets_document(header(*model), elements);
}

/// What both kinds of streams have: when the next part is due. A stream takes at most a fiftieth of
/// a worker, so that streams of large documents leave room for requests.
class Agent::PartStream : public api::TimedSource {
 public:
  PartStream(Agent& agent, AgentRequest request, std::string boundary)
      : agent_(agent),
        request_(std::move(request)),
        boundary_(std::move(boundary)),
        next_(agent.clock_.steady_now()) {}

  std::optional<std::string> take() final {
    if (has_ended_) return std::nullopt;
    const SteadyTime begin = agent_.clock_.steady_now();
    std::chrono::steady_clock::duration pause = std::max(*request_.interval, kShortest);
    share_ = {};
    auto xml = make(begin, pause);
    if (!xml && xml.error().status == kTryAgain) xml = "";
    std::string text;
    if (!xml) {
      has_ended_ = true;
      text = part_text(boundary_, agent_.refuse(xml.error()).body) +
             fmt::format("\r\n--{}--\r\n", boundary_);
    } else if (!xml->empty()) {
      text = part_text(boundary_, *xml);
    }
    const auto cost = agent_.clock_.steady_now() - begin;
    next_ = begin + std::max(pause, kCostShare * cost);
    return text;
  }

 protected:
  /// The next document; "": none now. `pause` until the next one may be changed.
  virtual Asked<std::string> make(SteadyTime now, std::chrono::steady_clock::duration& pause) = 0;

  /// False: too much is in progress.
  bool take_share(const std::string& xml) {
    auto share = agent_.budget_.take(xml.size());
    if (!share) return false;
    share_ = *std::move(share);
    return true;
  }

  static constexpr int kCostShare = 50;

  Agent& agent_;
  AgentRequest request_;
  const std::string boundary_;
  BodyBudget::Share share_;
  SteadyTime next_;
  bool has_ended_ = false;
};

/// `/current?interval=`: the whole state again and again.
class Agent::CurrentStream final : public PartStream {
 public:
  using PartStream::PartStream;

  Due due() override { return {.is_now = agent_.clock_.steady_now() >= next_, .next = next_}; }

 private:
  Asked<std::string> make(SteadyTime /*now*/,
                          std::chrono::steady_clock::duration& /*pause*/) override {
    auto xml = agent_.current(request_);
    if (xml && !take_share(*xml)) return "";
    return xml;
  }
};

/// `/sample?interval=`: what was observed since the part before, or after `heartbeat` without any
/// an empty part. When a part is full, the next one follows at once.
class Agent::SampleStream final : public PartStream {
 public:
  SampleStream(Agent& agent, AgentRequest request, std::string boundary)
      : PartStream(agent, std::move(request), std::move(boundary)),
        heartbeat_(next_ + request_.heartbeat) {}

  Due due() override {
    const SteadyTime now = agent_.clock_.steady_now();
    if (now < next_) return {.is_now = false, .next = next_};
    const bool has_more = looked_at_ == 0 || looked_at_ < agent_.buffer_.next();
    if (has_more || now >= heartbeat_ || has_ended_) return {.is_now = true, .next = now};
    next_ = std::min(now + std::max(*request_.interval, kShortest), heartbeat_);
    return {.is_now = false, .next = next_};
  }

 private:
  Asked<std::string> make(SteadyTime now, std::chrono::steady_clock::duration& pause) override {
    auto part = agent_.sample(request_);
    if (!part) return forward(part.error());
    if (!take_share(part->xml)) return "";
    request_.from = part->next;
    looked_at_ = part->next;
    if (part->size == static_cast<std::size_t>(request_.count)) pause = {};
    if (part->size == 0 && now < heartbeat_) return "";
    heartbeat_ = now + request_.heartbeat;
    return std::move(part->xml);
  }

  SteadyTime heartbeat_;
  std::uint64_t looked_at_ = 0;  ///< the number that is looked at next; 0: none was yet
};

/// What is wrong with the request at its beginning is an Error document with its status.
api::Response Agent::stream(const AgentRequest& request) {
  const bool is_current = request.kind == AgentRequest::Kind::Current;
  const auto model = model_.snapshot();
  if (auto items = items_of(*model, request); !items) return refuse(items.error());
  if (!is_current && request.from) {
    const auto range = buffer_.range();
    if (*request.from < range.first || *request.from > range.next)
      return refuse(
          out_of_range(fmt::format("'from' must be from {} to {}", range.first, range.next)));
  }
  const std::string boundary = random_hex(16);
  api::Response response;
  response.content_type = "multipart/x-mixed-replace;boundary=" + boundary;
  response.headers.emplace_back("Cache-Control", "no-cache, no-store, max-age=0");
  response.headers.emplace_back("Expires", "-1");
  AgentRequest asked = request;
  asked.count = std::min(request.count, AgentRequest::kMaxPart);
  if (is_current) {
    response.timed = std::make_shared<CurrentStream>(*this, std::move(asked), boundary);
  } else {
    response.timed = std::make_shared<SampleStream>(*this, std::move(asked), boundary);
  }
  return response;
}

}  // namespace dripline::mtconnect
