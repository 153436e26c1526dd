#pragma once
/// A field's value as text.
#include <string>

#include "tools/logs/fields/decoder.h"

namespace sprung::fields {

/// For people: numbers with `digits` significant digits, enumerations by name ("thrust (3)"), "true", texts
/// as they are, bytes in hex.
std::string value_text(const MessageView& message, const Field& field, int digits = 6);

/// For machines, appended to `out`: numbers so that reading them gives the same bits ("nan", "inf"),
/// enumerations as numbers, truths as 0 and 1, texts as they are, bytes in hex. Allocates only where `out`
/// must grow.
void append_exact(const MessageView& message, const Field& field, std::string& out);

}  // namespace sprung::fields
