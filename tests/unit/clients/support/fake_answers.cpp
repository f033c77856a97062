#include "tests/unit/clients/support/fake_answers.hpp"

namespace dripline::test_support {

using httplib::Response;
using nlohmann::json;

void answer(Response& response, int status, const json& body) {
  response.status = status;
  response.set_content(body.dump(), "application/json");
}

void answer_error(Response& response, int status, const std::string& code) {
  answer(response, status, {{"error", {{"code", code}, {"message", "fake: " + code}}}});
}

void cut(Response& response) {
  response.status = 200;
  response.set_content_provider(100, "application/json",
                                [](std::size_t, std::size_t, httplib::DataSink&) { return false; });
}

void refuse_damaged(Response& response) {
  response.status = 500;
  response.set_chunked_content_provider(
      "application/json", [](std::size_t, httplib::DataSink& sink) {
        const std::string text =
            json{{"error", {{"code", "corrupt"}, {"message", "chunk 3 is damaged"}}}}.dump();
        sink.write(text.data(), text.size());
        sink.done();
        return true;
      });
}

}  // namespace dripline::test_support
