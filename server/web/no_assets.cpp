// Takes the place of the generated page_assets.cpp where the page is not built.
#include "server/web/page_assets.hpp"

namespace dripline::web {

std::span<const Asset> embedded_assets() {
  return {};
}

}  // namespace dripline::web
