#include "storage/postgresql/url.hpp"

#include <libpq-fe.h>
#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

namespace dripline::storage::postgresql {
namespace {

struct OptionsDeleter {
  void operator()(PQconninfoOption* options) const { PQconninfoFree(options); }
};
using Options = std::unique_ptr<PQconninfoOption, OptionsDeleter>;

std::string value_of(const Options& options, std::string_view keyword) {
  for (const PQconninfoOption* option = options.get();
       option != nullptr && option->keyword != nullptr; ++option) {
    if (keyword == option->keyword) return option->val == nullptr ? "" : option->val;
  }
  return "";
}

}  // namespace

Result<UrlFacts> read_url(const std::string& url) {
  char* fault = nullptr;
  const Options given(PQconninfoParse(url.c_str(), &fault));
  PQfreemem(fault);
  if (given == nullptr)
    return fail(Errc::Syntax, "the database's URL cannot be read: postgresql://HOST:PORT/NAME");
  UrlFacts facts{.database = value_of(given, "dbname"),
                 .has_password = !value_of(given, "password").empty()};
  // As libpq continues: the environment, then the user's name.
  const Options defaults(PQconndefaults());
  if (facts.database.empty()) facts.database = value_of(defaults, "dbname");
  if (facts.database.empty()) facts.database = value_of(given, "user");
  if (facts.database.empty()) facts.database = value_of(defaults, "user");
  return facts;
}

Result<void> check_name(const std::string& database) {
  constexpr std::array<std::string_view, 3> kOwn{"postgres", "template0", "template1"};
  if (std::ranges::find(kOwn, database) == kOwn.end()) return {};
  return fail(Errc::Unsupported,
              "database {}: PostgreSQL keeps it for itself{}; make one for the server (createdb "
              "--encoding=UTF8 --template=template0 dripline) and name that",
              database,
              database == "postgres" ? " and its tools" : ", and every new one is a copy of it");
}

}  // namespace dripline::storage::postgresql
