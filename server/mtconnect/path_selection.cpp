#include "server/mtconnect/path_selection.hpp"

#include <libxml/parser.h>
#include <libxml/xpath.h>
#include <ctime>

#include "server/mtconnect/documents.hpp"

namespace dripline::mtconnect {
namespace {

template <class T, void (*kFree)(T*)>
struct Freed {
  void operator()(T* object) const { kFree(object); }
};
using Document = std::unique_ptr<xmlDoc, Freed<xmlDoc, xmlFreeDoc>>;
using Context = std::unique_ptr<xmlXPathContext, Freed<xmlXPathContext, xmlXPathFreeContext>>;
using Expression = std::unique_ptr<xmlXPathCompExpr, Freed<xmlXPathCompExpr, xmlXPathFreeCompExpr>>;
using Found = std::unique_ptr<xmlXPathObject, Freed<xmlXPathObject, xmlXPathFreeObject>>;

/// libxml2 would print its errors; some it only prints.
void ignore(void* /*data*/, xmlErrorPtr /*error*/) {}
void print_nothing(void* /*data*/, const char* /*format*/, ...) {
}  // NOLINT(cert-dcl50-cpp): libxml2's

tl::unexpected<AgentError> invalid(std::string text) {
  return tl::unexpected<AgentError>(AgentError{400, "INVALID_PATH", std::move(text)});
}

const xmlChar* as_xml(const char* text) {
  return reinterpret_cast<const xmlChar*>(text);
}

bool has_name(const xmlNode* node, const char* name) {
  return node->type == XML_ELEMENT_NODE && xmlStrEqual(node->name, as_xml(name)) != 0;
}

/// The ids of all data items at and below `node`.
void collect(const xmlNode* node, std::vector<std::string>& ids) {
  if (has_name(node, "DataItem")) {
    xmlChar* id = xmlGetProp(node, as_xml("id"));
    if (id != nullptr) ids.emplace_back(reinterpret_cast<const char*>(id));
    xmlFree(id);
  }
  for (const xmlNode* child = node->children; child != nullptr; child = child->next) {
    if (child->type == XML_ELEMENT_NODE) collect(child, ids);
  }
}

std::chrono::nanoseconds thread_time() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// Counts the evaluations of new expressions; those over the limit are refused.
class Turn {
 public:
  explicit Turn(std::atomic<int>& count) : count_(count), is_taken_(true) {
    if (++count_ > PathSelection::kMaxAtOnce) give_back();
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() {
    if (is_taken_) give_back();
  }
  bool is_taken() const { return is_taken_; }

 private:
  void give_back() {
    --count_;
    is_taken_ = false;
  }
  std::atomic<int>& count_;
  bool is_taken_;
};

/// Once for the process, before the first use from several threads.
void start_libxml() {
  static const bool kStarted = [] {
    xmlInitParser();
    return true;
  }();
  static_cast<void>(kStarted);
}

}  // namespace

Asked<std::vector<std::uint32_t>> select_items(const Model& model, const Device& device,
                                               const std::string& path) {
  start_libxml();
  xmlSetGenericErrorFunc(nullptr, print_nothing);  // of this thread
  const std::string text = path_document(model, device);
  const Document document(xmlReadMemory(text.data(), static_cast<int>(text.size()), nullptr,
                                        "UTF-8", XML_PARSE_NONET | XML_PARSE_NOERROR));
  const Context context(document ? xmlXPathNewContext(document.get()) : nullptr);
  if (!context) return tl::unexpected<AgentError>(AgentError{500, "INTERNAL_ERROR", "no memory"});
  context->error = ignore;
  context->opLimit = PathSelection::kOperations;
  const Expression expression(xmlXPathCtxtCompile(context.get(), as_xml(path.c_str())));
  if (!expression) return invalid("'path' is not a valid XPath");
  const Found found(xmlXPathCompiledEval(expression.get(), context.get()));
  if (!found) return invalid("'path' cannot be evaluated, or costs too much");
  if (found->type != XPATH_NODESET) return invalid("'path' does not select elements");
  std::vector<std::string> ids;
  const xmlNodeSet* nodes = found->nodesetval;
  // Nested elements name the same items again: as many as the limit of operations at most.
  for (int i = 0; nodes != nullptr && i < nodes->nodeNr; ++i) {
    if (nodes->nodeTab[i]->type == XML_ELEMENT_NODE) collect(nodes->nodeTab[i], ids);
    if (nodes->nodeTab[i]->type == XML_DOCUMENT_NODE)
      collect(xmlDocGetRootElement(document.get()), ids);
  }
  std::map<std::string_view, std::uint32_t> by_id;
  for (const std::uint32_t item : device.items) {
    if (item != Device::kNone) by_id.emplace(model.items[item]->id, item);
  }
  std::vector<std::uint32_t> items;
  items.reserve(ids.size());
  for (const auto& id : ids) items.push_back(by_id.at(id));
  return items;
}

std::shared_ptr<PathSelection::Kept> PathSelection::keep(const std::string& path) {
  const std::lock_guard lock(mutex_);
  auto& kept = kept_[path];
  if (kept) return kept;
  kept = std::make_shared<Kept>();
  order_.push_back(path);
  auto made = kept;
  if (order_.size() > kMaxKept) {
    kept_.erase(order_.front());
    order_.pop_front();
  }
  return made;
}

void PathSelection::evaluate(Kept& kept, const Model& model, const std::string& path) {
  const auto end = thread_time() + kMaxTime;
  kept.devices.resize(model.devices.size());
  for (const auto& device : model.devices) {
    Selected& selected = kept.devices[device->index];
    if (selected.revision == device->revision) continue;
    auto items = select_items(model, *device, path);
    if (items && thread_time() > end) {
      items = tl::unexpected<AgentError>(
          AgentError{400, "INVALID_PATH", "'path' takes too long to be evaluated"});
    }
    if (!items) {
      kept.error = items.error();
      return;
    }
    selected = {device->revision, *std::move(items)};
  }
}

Asked<std::shared_ptr<const ItemSet>> PathSelection::select(const Model& model, const Device* only,
                                                            const std::string& path) {
  const auto kept = keep(path);
  const std::lock_guard lock(kept->mutex);
  if (kept->error) return tl::unexpected<AgentError>(*kept->error);
  if (kept->revision == 0) {
    const Turn turn(evaluations_);
    if (!turn.is_taken()) {
      return tl::unexpected<AgentError>(AgentError{
          503, "INTERNAL_ERROR", "too many paths are being evaluated; ask again in a second"});
    }
    evaluate(*kept, model, path);
  } else if (kept->revision != model.revision) {
    evaluate(*kept, model, path);
  }
  if (kept->error) return tl::unexpected<AgentError>(*kept->error);
  if (kept->revision != model.revision) {
    kept->answers.clear();
    kept->revision = model.revision;
  }
  if (kept->answers.size() >= kMaxAnswers) kept->answers.clear();
  auto& answer = kept->answers[only == nullptr ? -1 : std::int64_t{only->index}];
  if (!answer) {
    auto items = std::make_shared<ItemSet>();
    for (const auto& device : model.devices) {
      if (only != nullptr && only->index != device->index) continue;
      for (const std::uint32_t item : kept->devices[device->index].items) items->add(item);
    }
    answer = std::move(items);
  }
  if (answer->size() == 0) return invalid("'path' selects no data item");
  return answer;
}

}  // namespace dripline::mtconnect
