"""Find what the rotation part of a logged action means: `bench.audit.actions.report.audit_actions`, `audit actions`."""
