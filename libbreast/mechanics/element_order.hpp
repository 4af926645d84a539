// raise_order() lives with the meshes; here for the mechanics, whose tools raise the order.
#pragma once

#include "mesh/element_order.hpp"
