"""Films of falls and scenes, as animated WebP."""
