"""The audit of random scenes: what a run tells is computed again from its history (scripts/audit-scenes)."""
