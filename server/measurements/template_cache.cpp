#include "server/measurements/template_cache.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"

namespace dripline::measurements {
namespace {

using storage::TemplateAssignment;
using storage::TemplateScope;

Result<UsedTemplate> read(const storage::ReportTemplateVersion& version) {
  auto content = report_template::read_template(version.text);
  if (!content) {
    return fail(content.error().code, "report template {} version {}: {}", version.name,
                version.version, content.error().what);
  }
  return UsedTemplate{
      .name = version.name,
      .version = version.version,
      .content = std::make_shared<const report_template::ReportTemplate>(*std::move(content))};
}

bool applies(const TemplateAssignment& assignment, const std::string& machine,
             const std::string& program) {
  switch (assignment.scope) {
    case TemplateScope::Program:
      return !program.empty() && assignment.subject == program;
    case TemplateScope::Machine:
      return assignment.subject == machine;
    case TemplateScope::Macro:
      return true;
  }
  return false;
}

}  // namespace

void TemplateCache::drop() {
  const std::lock_guard lock(mutex_);
  is_loaded_ = false;
}

Result<bool> TemplateCache::has_assignments() {
  const std::lock_guard lock(mutex_);
  if (auto loaded = load(); !loaded) return fail(loaded.error());
  return !assignments_.empty();
}

Result<void> TemplateCache::load() {
  if (is_loaded_) return {};
  auto assignments = store_.assignments();
  if (!assignments) return fail(assignments.error());
  newest_.clear();
  for (const TemplateAssignment& assignment : *assignments) {
    auto found = store_.find(assignment.name, assignment.version);
    if (!found) {
      if (found.error().code == Errc::NotFound) continue;
      return fail(found.error());
    }
    if (!assignment.version) newest_[assignment.name] = found->version;
    if (read_.contains({found->name, found->version})) continue;
    auto used = read(*found);
    if (!used) {
      process::log_error("a report template is not used: {}", used.error().what);
      continue;
    }
    read_.emplace(std::pair(found->name, found->version), *std::move(used));
  }
  assignments_ = *std::move(assignments);
  // The scopes are ordered as they are asked.
  std::ranges::stable_sort(assignments_, {}, &TemplateAssignment::scope);
  is_loaded_ = true;
  return {};
}

Result<std::vector<UsedTemplate>> TemplateCache::templates_of(const std::string& machine,
                                                              const std::string& program) {
  const std::lock_guard lock(mutex_);
  if (auto loaded = load(); !loaded) return fail(loaded.error());
  std::vector<UsedTemplate> all;
  for (const TemplateAssignment& assignment : assignments_) {
    if (!applies(assignment, machine, program)) continue;
    const auto is_there = [&](const UsedTemplate& used) { return used.name == assignment.name; };
    if (std::ranges::any_of(all, is_there)) continue;
    const auto newest = newest_.find(assignment.name);
    const std::uint64_t version =
        assignment.version.value_or(newest == newest_.end() ? 0 : newest->second);
    const auto found = read_.find({assignment.name, version});
    if (found == read_.end()) continue;
    all.push_back(found->second);
    all.back().is_of_macro = assignment.scope == TemplateScope::Macro;
  }
  return all;
}

Result<UsedTemplate> TemplateCache::find(const std::string& name,
                                         std::optional<std::uint64_t> version) {
  if (version) {
    const std::lock_guard lock(mutex_);
    if (const auto known = read_.find({name, *version}); known != read_.end()) return known->second;
  }
  const auto found = store_.find(name, version);
  if (!found) return fail(found.error());
  auto used = read(*found);
  if (!used) return used;
  const std::lock_guard lock(mutex_);
  return read_.emplace(std::pair(found->name, found->version), *std::move(used)).first->second;
}

}  // namespace dripline::measurements
