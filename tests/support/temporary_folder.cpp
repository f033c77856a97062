#include "tests/support/temporary_folder.hpp"

#include <unistd.h>
#include <cstdlib>
#include <string>

#include "protocol/base/invariant.hpp"

namespace dripline::test_support {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "dripline-XXXXXX").string();
  invariant(::mkdtemp(name.data()) != nullptr, "a temporary folder can be made");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (std::getenv("DRIPLINE_KEEP") == nullptr) std::filesystem::remove_all(path_, ignored);
}

}  // namespace dripline::test_support
