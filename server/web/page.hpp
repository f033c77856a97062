#pragma once

#include <optional>
#include <span>

#include "server/api/request.hpp"
#include "server/api/response.hpp"
#include "server/web/page_assets.hpp"

namespace dripline::web {

/// Adds what every page of the server tells a browser: only files of this server run or are shown,
/// and nothing is framed or sent elsewhere.
void add_protection(api::Response& response);

/// Answers the requests for the web page: `/` and `/assets/...`, GET and HEAD, without a token,
/// since they hold nothing of the shop. Whatever else is asked for is the API's. Any thread; never
/// waits.
class Page {
 public:
  /// `assets` must outlive the page; none: `/` says how to add the page.
  explicit Page(std::span<const Asset> assets) : assets_(assets) {}

  /// nullopt: the request is not for the page.
  std::optional<api::Response> answer(const api::Request& head) const;

 private:
  api::Response send(const Asset& asset, const api::Request& head) const;
  std::span<const Asset> assets_;
};

}  // namespace dripline::web
