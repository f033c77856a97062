#include "gateway/interpreter/dialects/rs274ngc/memory/names.hpp"

namespace dripline::interpreter::rs274ngc {

NameId NamedParameters::id_of(std::string_view name) {
  if (const NameId known = find(name); known != kNoName) return known;
  if (names_.size() == kMaxNames || name.empty() || name.size() > kMaxNameLength) return kNoName;
  const auto id = static_cast<NameId>(names_.size());
  names_.emplace_back(name);
  ids_.emplace(names_.back(), id);
  return id;
}

NameId NamedParameters::find(std::string_view name) const {
  const auto at = ids_.find(name);
  return at == ids_.end() ? kNoName : at->second;
}

const double* NamedParameters::value(NameId id, std::size_t level) const {
  const Values& all = values(id, level);
  return id < all.size() && all[id].is_defined ? &all[id].value : nullptr;
}

void NamedParameters::set(NameId id, std::size_t level, double value) {
  Values& all = is_global(id) ? globals_ : locals_[level];
  if (id >= all.size()) all.resize(std::size_t{id} + 1);
  all[id] = {value, true};
  ++changes_;
}

void NamedParameters::enter(std::size_t level) {
  locals_[level].clear();
  ++changes_;
}

}  // namespace dripline::interpreter::rs274ngc
