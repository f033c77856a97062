// The calls of Client for hot folders.
#include "clients/lib/api_json.hpp"
#include "clients/lib/client.hpp"
#include "clients/lib/impl/request.hpp"

namespace dripline::client {

using impl::path_of;
using impl::with_query;

Reply<std::vector<Folder>> Client::folders() {
  return fetch_list<Folder>(path_of("folders"), "folders");
}

Reply<std::vector<FolderFile>> Client::folder_files(std::string_view folder, Page page) {
  std::string path = path_of("folders", folder) + "/files";
  path = with_query(std::move(path), "limit", std::to_string(page.limit));
  path = with_query(std::move(path), "offset", std::to_string(page.offset));
  return fetch_list<FolderFile>(path, "files");
}

}  // namespace dripline::client
