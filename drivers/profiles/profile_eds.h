#pragma once
/// A profile's EDS, for tools and simulations; apart from the registry, so that the bridge needs no EDS
/// reader.
#include "drivers/canopen/eds.h"
#include "drivers/profiles/profile_registry.h"

namespace sprung {

/// The EDS of a profile that has one, with what is beside it.
canopen::Eds profile_eds(const ProfileKind& kind, int node);

}  // namespace sprung
