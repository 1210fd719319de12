"""Operations and time per tick."""
