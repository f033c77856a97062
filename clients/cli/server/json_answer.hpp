#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "clients/cli/context.hpp"

/// Answers of the server that are shown from its JSON, without types of their own.
namespace dripline::cli {

/// Calls `show` with the answer and gives its status; an answer of another form is complained of.
/// `call`: what it answers, for the complaint: " to the check".
int shown_json(const client::Client& client, const std::string& answer,
               const std::function<int(const nlohmann::ordered_json&)>& show,
               std::string_view call = {});

/// The end of a command whose call gave `answer`: complains of its failure, prints it with --json,
/// or lets `print` do it. Gives the exit status.
int print_answer(const Context& context, const client::Client& client,
                 const client::Reply<std::string>& answer,
                 const std::function<void(const nlohmann::ordered_json&)>& print);

/// How the list `name` of an answer is printed.
struct Listing {
  const char* name;
  const char* when_empty;  ///< a sentence
  Table (*table)(const nlohmann::ordered_json&);
};
int print_listing(const Context& context, const client::Client& client,
                  const client::Reply<std::string>& answer, const Listing& listing);

/// A member's text as it came; empty: there is no text of that name.
std::string text_at(const nlohmann::ordered_json& object, const char* key);

}  // namespace dripline::cli
