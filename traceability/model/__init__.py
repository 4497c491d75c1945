"""The model: it joins the readings, and derives trees, states and coverage from them."""
