#include "core/numerics/dense_instances.h"

LINKSTUDY_DENSE_INSTANCES()
