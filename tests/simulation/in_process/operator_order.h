#pragma once
/// What an operator says to a robot in this process.
#include "signals/operator.h"

namespace sprung::test {

inline OperatorCommand order_of(OperatorKind kind, std::int64_t request_id) {
  OperatorCommand order;
  order.kind = kind;
  order.request_id = request_id;
  return order;
}

}  // namespace sprung::test
