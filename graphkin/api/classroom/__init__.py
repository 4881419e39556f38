"""Papers and judgement for a class: handouts, sets of problems, course projects, audits."""
