#pragma once

#include <httplib.h>
#include <nlohmann/json.hpp>
#include <string>

/// What FakeServer answers with.
namespace dripline::test_support {

void answer(httplib::Response& response, int status, const nlohmann::json& body);
void answer_error(httplib::Response& response, int status, const std::string& code);
/// Begins an answer and cuts the connection.
void cut(httplib::Response& response);
/// In chunks: of any other body the library would cut the wanted range out.
void refuse_damaged(httplib::Response& response);

}  // namespace dripline::test_support
