#include "gateway/interpreter/registry.hpp"

#include <algorithm>

#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/dialects/centurion/reading/program_calls.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/program_calls.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/program_calls.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/program_calls.hpp"

namespace dripline::interpreter {
namespace {

/// A candidate this far ahead of the next leaves no doubt.
constexpr int kClearLead = 30;

/// One line for each dialect.
const std::vector<Dialect>& table() {
  static const std::vector<Dialect> kTable{
      kCenturionDialect, kFanucDialect,    kFanucLatheDialect,    kItncDialect,
      kProtoTrakDialect, kRs274NgcDialect, kTektronix1704Dialect, kTnc155Dialect};
  return kTable;
}

std::string known_names() {
  std::string names;
  for (const Dialect& dialect : table()) {
    if (!names.empty()) names += ", ";
    names += dialect.name;
  }
  return names;
}

}  // namespace

std::span<const Dialect> dialects() {
  return table();
}

Result<const Dialect*> find_dialect(std::string_view name) {
  for (const Dialect& dialect : table()) {
    if (dialect.name == name) return &dialect;
  }
  return fail(Errc::NotFound, "control \"{}\" is not known; known are: {}", name, known_names());
}

CallReader call_reader(std::string_view name) {
  if (name == kFanucDialect.name) return &fanuc::program_calls;
  if (name == kFanucLatheDialect.name) return &fanuc::lathe_program_calls;
  if (name == kCenturionDialect.name) return &centurion::program_calls;
  if (name == kRs274NgcDialect.name) return &rs274ngc::program_calls;
  if (name == kTnc155Dialect.name) return &tnc155::program_calls;
  if (name == kItncDialect.name) return &tnc155::itnc_program_calls;
  return nullptr;
}

std::vector<const Dialect*> detect_dialect(std::string_view head, std::string_view file_name) {
  struct Candidate {
    const Dialect* dialect;
    int likelihood;
  };
  std::vector<Candidate> candidates;
  for (const Dialect& dialect : table()) {
    const int likelihood = dialect.likelihood(head, file_name);
    if (likelihood > 0) candidates.push_back({&dialect, likelihood});
  }
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.likelihood > b.likelihood; });
  if (candidates.size() > 1 && candidates[0].likelihood >= candidates[1].likelihood + kClearLead) {
    candidates.erase(candidates.begin() + 1, candidates.end());
  }
  std::vector<const Dialect*> found;
  found.reserve(candidates.size());
  for (const Candidate& candidate : candidates) found.push_back(candidate.dialect);
  return found;
}

}  // namespace dripline::interpreter
