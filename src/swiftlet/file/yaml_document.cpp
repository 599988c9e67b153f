// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <exception>
#include <sstream>
#include <unordered_map>
#include <utility>
#include <vector>

#include "swiftlet/file/yaml_document_private.hpp"

namespace swiftlet {
namespace {

/// Ends the parser from within an event; it never leaves this file.
struct Refusal {
  YAML::Mark mark;
  std::string what;
  std::string remedy;
};

/// Counts the nodes that the tree of a document would have, with all that its aliases repeat.
class NodeCounter final : public YAML::EventHandler {
 public:
  NodeCounter(std::size_t bytes, const YamlLimits& limits)
      : max_depth_(limits.depth),
        max_nodes_(std::min(limits.nodes, limits.nodes_to_begin + limits.nodes_per_byte * bytes)) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (std::exchange(has_document_, true))
      throw Refusal{mark, "a second document starts", "put everything into the first"};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { leaf(mark, anchor); }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& /*value*/) override {
    leaf(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto meant = sizes_.find(anchor);
    if (meant == sizes_.end())
      throw Refusal{mark, "an alias stands within what it repeats", "write out what is meant"};
    if (open_.size() + meant->second.depth > max_depth_) too_deep(mark);
    add(mark, meant->second.nodes);
    deepen(meant->second.depth);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Size {
    std::size_t nodes = 0;
    std::size_t depth = 0;  // lists and groups within each other, this one counted
  };
  struct Open {
    YAML::anchor_t anchor;
    std::size_t nodes_before;
    std::size_t depth = 1;
  };

  [[noreturn]] void too_deep(const YAML::Mark& mark) const {
    throw Refusal{mark,
                  fmt::format("lists and groups lie more than {} deep in each other", max_depth_),
                  "write it flatter"};
  }
  void add(const YAML::Mark& mark, std::size_t nodes) {
    nodes_ += nodes;
    if (nodes_ <= max_nodes_) return;
    throw Refusal{mark, fmt::format("the text stands for more than {} values", max_nodes_),
                  "use fewer aliases or make it smaller"};
  }
  void deepen(std::size_t below) {
    if (!open_.empty()) open_.back().depth = std::max(open_.back().depth, 1 + below);
  }
  void leaf(const YAML::Mark& mark, YAML::anchor_t anchor) {
    add(mark, 1);
    if (anchor != YAML::NullAnchor) sizes_[anchor] = {1, 0};
  }
  void open(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() >= max_depth_) too_deep(mark);
    open_.push_back({anchor, nodes_});
    add(mark, 1);
  }
  void close() {
    const Open done = open_.back();
    open_.pop_back();
    deepen(done.depth);
    if (done.anchor != YAML::NullAnchor)
      sizes_[done.anchor] = {nodes_ - done.nodes_before, done.depth};
  }

  std::size_t max_depth_;
  std::size_t max_nodes_;
  std::size_t nodes_ = 0;
  bool has_document_ = false;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, Size> sizes_;  // of what is complete
};

void count_nodes(const std::string& text, const YamlLimits& limits) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  NodeCounter counter(text.size(), limits);
  while (parser.HandleNextDocument(counter)) {
  }
}

tl::unexpected<Error> refused(const std::string& place, const YAML::Mark& mark, std::string what,
                              std::string remedy) {
  const std::string where = mark.is_null() ? place : fmt::format("{}:{}", place, mark.line + 1);
  return fail(ErrorCode::kInvalidConfig, where, std::move(what), std::move(remedy));
}

}  // namespace

Expected<YAML::Node> parse_yaml(std::string_view text, const std::string& place,
                                const YamlLimits& limits) {
  if (text.size() > limits.bytes) {
    return fail(ErrorCode::kInvalidConfig, place,
                fmt::format("it has {} bytes, more than the {} that are read of YAML", text.size(),
                            limits.bytes),
                "is this the right file?");
  }
  const std::string copy(text);
  // yaml-cpp reports by exception; none passes this function.
  try {
    count_nodes(copy, limits);
    return YAML::Load(copy);
  } catch (const Refusal& refusal) {
    return refused(place, refusal.mark, refusal.what, refusal.remedy);
  } catch (const YAML::Exception& error) {
    return refused(place, error.mark, "this is not YAML: " + error.msg,
                   "mend the line or the one before it");
  } catch (const std::exception& error) {  // of the library below yaml-cpp
    return fail(ErrorCode::kInvalidConfig, place, std::string("this is not YAML: ") + error.what());
  }
}

}  // namespace swiftlet
