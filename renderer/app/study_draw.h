// The way from a scene to a picture that studies are given.
#pragma once

#include "app/render_session.h"
#include "study/hard_case.h"

namespace crosslight {

// Draws by the session, which must outlive it. What is not finite is counted; what is unusual about made-up scenes is
// not said.
study::Draw drawBy(RenderSession& session);

}  // namespace crosslight
