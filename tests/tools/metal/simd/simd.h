// Empty: naga includes it, and nothing of it is used. See ../metal_stdlib.
#pragma once
