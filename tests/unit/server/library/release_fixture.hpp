#pragma once

#include <string>

#include "tests/unit/server/api/server_fixture.hpp"

namespace dripline::server_test {

/// Steps of revisions, on top of any fixture with a library.
template <class Base>
class ReleaseSteps : public Base {
 protected:
  struct By {
    std::string who = "anna";
    storage::Role role = storage::Role::Administrator;
    std::string comment = "";
  };
  Result<storage::Revision> try_decide(const std::string& program, std::uint64_t revision,
                                       storage::RevisionStep step, const By& by) {
    return this->releases_->decide({.program = program,
                                    .revision = revision,
                                    .step = step,
                                    .comment = by.comment,
                                    .who = {by.who, "token", "192.0.2.1"},
                                    .role = by.role});
  }
  void decide(const std::string& program, std::uint64_t revision, storage::RevisionStep step) {
    const auto decided = try_decide(program, revision, step, {});
    EXPECT_TRUE(decided) << decided.error().what;
  }
  void take_to_release(const std::string& program, std::uint64_t revision) {
    using enum storage::RevisionStep;
    for (const auto step : {Submit, Approve, Release}) decide(program, revision, step);
  }
  storage::Revision release(const std::string& program, const std::string& text) {
    const auto revision = this->push(program, text);
    take_to_release(program, revision.number);
    return this->programs_->revision(program, revision.number).value();
  }
};

}  // namespace dripline::server_test
