#include "tools/lab/identify/protocol_request.h"

#include <algorithm>
#include <stdexcept>

#include "tools/lab/identify/text_parts.h"

namespace sprung::identify {

using identification::JointTerm;
using identification::JointTerms;
using identification::Protocol;
using identification::RobustLoss;

namespace {

constexpr JointTerm kLastTerm = JointTerm::kRipple4;

JointTerm term_named(const std::string& name) {
  std::string known;
  for (int i = 0; i <= static_cast<int>(kLastTerm); ++i) {
    const auto term = static_cast<JointTerm>(i);
    if (name == identification::name(term)) return term;
    known += (i == 0 ? "" : ", ") + std::string(identification::name(term));
  }
  throw std::invalid_argument("--models: no term '" + name + "'; there are coulomb (always), " + known +
                              "; joined by +");
}

RobustLoss loss_named(const std::string& name) {
  if (name == "none") return RobustLoss::kNone;
  if (name == "tukey") return RobustLoss::kTukey;
  if (name == "huber") return RobustLoss::kHuber;
  throw std::invalid_argument("--robust " + name + ": there are none, huber, tukey");
}

}  // namespace

JointTerms terms_of(const std::string& name) {
  JointTerms out;
  for (const std::string& part : split(name, '+')) {
    if (part != "coulomb") out.push_back(term_named(part));
  }
  std::sort(out.begin(), out.end());
  return out;
}

Protocol protocol_of(const ProtocolRequest& request) {
  Protocol out;
  if (!request.window.empty()) {
    const auto window = parse_spans(request.window, "--window");
    if (window.size() != 1) throw std::invalid_argument("--window takes one span, for example 8:60");
    out.window = window.front();
  }
  if (request.resample_Hz < 0.0) throw std::invalid_argument("--resample must not be negative");
  if (request.blocks < 2) throw std::invalid_argument("--blocks: at least 2");
  out.train = parse_spans(request.train, "--train");
  out.test = parse_spans(request.test, "--test");
  out.prepare.rate_Hz = request.resample_Hz;
  out.prepare.smoothing_s = request.smoothing_s;
  out.search.validation.blocks = request.blocks;
  out.search.validation.fit.loss = loss_named(request.robust);
  if (request.models != "all") {
    for (const std::string& name : split(request.models, ',')) out.search.only.push_back(terms_of(name));
  }
  return out;
}

}  // namespace sprung::identify
