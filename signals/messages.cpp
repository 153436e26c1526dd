#include "signals/messages.h"
